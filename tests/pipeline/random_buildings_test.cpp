#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "geometry/geos.hpp"
#include "geometry/overlay.hpp"
#include "pipeline/pipeline_case.hpp"

namespace d2b {
namespace {

using test::area_of;
using test::buildings;
using test::contours;
using test::doubtful;
using test::MemorySink;
using test::MemorySource;

/// Blocks of random sizes and heights on a slope, over and beside each other and cut by the edge, rough
/// places, and points that are not valid.
MemorySource random_blocks(unsigned seed) {
    std::mt19937 random(seed);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    const int rows = 1 + below(60);
    const int cols = 1 + below(60);
    std::vector<double> z;
    for (int i = 0; i < rows * cols; ++i)
        z.push_back(50 + 0.02 * (i % cols) + 0.001 * below(100));
    const int blocks = below(12);
    for (int b = 0; b < blocks; ++b) {
        const int top = below(rows);
        const int left = below(cols);
        const int height = 1 + below(20);
        const int width = 1 + below(20);
        const double roof = 55 + 2.5 * below(8);
        const bool rough = below(4) == 0;
        for (int r = top; r < std::min(rows, top + height); ++r)
            for (int c = left; c < std::min(cols, left + width); ++c)
                z[static_cast<std::size_t>(r * cols + c)] = roof + (rough ? 0.5 * below(10) : 0.0);
    }
    if (seed % 3 == 0)
        for (double& value : z)
            if (below(30) == 0)
                value = std::numeric_limits<double>::quiet_NaN();
    return {rows, cols, std::move(z)};
}

Options random_options(unsigned seed) {
    Options options;
    options.detect.min_confidence = seed % 2 == 0 ? 0.001 : 0.995;
    options.filter.min_area_m2 = seed % 5;
    options.filter.noise_factor = static_cast<int>(seed % 4 * 4);
    options.detect.split_height = seed % 3 == 1 ? 2 : 0;
    options.levels.source = seed % 7 == 0 ? LevelSource::global : LevelSource::building;
    options.outline.walls = std::array{Walls::automatic, Walls::off, Walls::right, Walls::free}[seed / 2 % 4];
    options.levels.detail = seed % 3 == 0 ? 1 : 0;
    options.write.doubtful = true;
    return options;
}

void expect_sound_records(const MemorySink& sink, std::size_t layer) {
    for (std::size_t i = 0; i < sink.features[layer].size(); ++i) {
        EXPECT_GT(sink.number(layer, i, "area_m2"), 0);
        EXPECT_GE(sink.number(layer, i, "confidence"), 0);
        EXPECT_LE(sink.number(layer, i, "confidence"), 1);
        EXPECT_LE(sink.whole(layer, i, "n_points"), sink.whole(layer, i, "n_cells"));
        EXPECT_GE(sink.number(layer, i, "ground"), 49);
        EXPECT_LE(sink.number(layer, i, "ground"), 80);
    }
}

class RandomBuildings : public testing::TestWithParam<unsigned> {};

TEST_P(RandomBuildings, AreValidDisjointAndNested) {
    MemorySource dem = random_blocks(GetParam());
    MemorySink sink;
    const RunReport report = run(random_options(GetParam()), {dem}, {sink});
    ASSERT_TRUE(sink.finished);
    EXPECT_EQ(report.counted(Reason::polygon_repaired), 0);
    EXPECT_EQ(report.counted(Reason::polygon_lost), 0);
    Geos geos;
    std::vector<Polygons> objects;
    for (const std::size_t layer : {buildings, doubtful})
        for (const Feature& feature : sink.features[layer]) {
            EXPECT_EQ(geos.invalidity(feature.parts), "");
            objects.push_back(feature.parts);
        }
    EXPECT_EQ(area_of(Overlay().dissolve(objects).twice), 0);
    expect_sound_records(sink, buildings);
    expect_sound_records(sink, doubtful);
    std::map<std::int64_t, const Feature*> by_id;
    for (std::size_t i = 0; i < sink.features[contours].size(); ++i)
        by_id[sink.whole(contours, i, "id")] = &sink.features[contours][i];
    for (std::size_t i = 0; i < sink.features[contours].size(); ++i) {
        const Feature& contour = sink.features[contours][i];
        EXPECT_EQ(geos.invalidity(contour.parts), "");
        const FieldValue parent = sink.value(contours, i, "parent_id");
        EXPECT_EQ(std::holds_alternative<std::int64_t>(parent), sink.whole(contours, i, "level") > 1);
        if (const auto* id = std::get_if<std::int64_t>(&parent)) {
            EXPECT_LT(geos.area_outside(contour.parts[0], by_id.at(*id)->parts[0]), 1e-9);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomBuildings, testing::Range(0U, 300U));

TEST(RandomBuildingsTogether, AreMany) {
    std::size_t found = 0;
    std::size_t unsure = 0;
    std::size_t tiers = 0;
    for (unsigned seed = 0; seed < 300; seed += 3) {
        MemorySource dem = random_blocks(seed);
        MemorySink sink;
        const RunReport report = run(random_options(seed), {dem}, {sink});
        found += sink.features[buildings].size();
        unsure += sink.features[doubtful].size();
        tiers += sink.features[contours].size() - sink.features[buildings].size();
    }
    EXPECT_GT(found, 100U);
    EXPECT_GT(unsure, 10U);
    EXPECT_GT(tiers, 50U);
}

}  // namespace
}  // namespace d2b

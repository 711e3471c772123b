#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "geometry/geos.hpp"
#include "geometry/overlay.hpp"
#include "pipeline/made_town.hpp"
#include "pipeline/pipeline_case.hpp"

namespace d2b::test {
namespace {

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

constexpr std::size_t rejected = 2;  // after buildings and contours

std::map<std::string, int> reasons(const MemorySink& sink) {
    std::map<std::string, int> counts;
    for (std::size_t i = 0; i < sink.features[rejected].size(); ++i)
        ++counts[std::get<std::string>(sink.value(rejected, i, "reason"))];
    return counts;
}

void expect_all_are_there(const MemorySink& sink, const RunReport& report) {
    std::map<std::string, int> counts = reasons(sink);
    for (const Reason reason : {Reason::contour_short, Reason::contour_small, Reason::contour_on_dropped,
                                Reason::hole_short, Reason::hole_small, Reason::polygon_repaired}) {
        const auto name = std::string(reason_names[static_cast<std::size_t>(reason)]);
        EXPECT_EQ(counts[name], report.counted(reason)) << name;
    }
}

/// 16 x 16 cells of 0. A plate of 10 x 10 cells at 20 has a pit of a cell and one of 4 x 4 cells; on it
/// stands a cell at 40; beside it a cell at 20.
MemorySource plate() {
    std::vector<double> z(256, 0);
    const auto set = [&](int row, int col, int rows, int cols, double value) {
        for (int r = row; r < row + rows; ++r)
            for (int c = col; c < col + cols; ++c)
                z[static_cast<std::size_t>(r * 16 + c)] = value;
    };
    set(2, 2, 10, 10, 20);
    set(3, 3, 1, 1, 0);
    set(6, 6, 4, 4, 0);
    set(4, 10, 1, 1, 40);
    set(14, 14, 1, 1, 20);
    return {16, 16, z};
}

TEST(Rejected, WhatTheFilterTookIsThereAsItWasTraced) {
    MemorySource source = plate();
    Options options = cells({10, 30});
    options.filter.noise_factor = 10;
    options.write.rejected = true;
    MemorySink sink;
    const RunReport report = run(options, {source}, {sink});
    ASSERT_EQ(sink.layers.size(), 3U);
    EXPECT_EQ(sink.layers[rejected].name, "rejected");
    EXPECT_EQ(sink.layers[rejected].title, "Rejected");
    EXPECT_EQ(reasons(sink), (std::map<std::string, int>{{"contour_short", 2}, {"hole_short", 1}}));
    expect_all_are_there(sink, report);
    // Features in the order of keys: level 1, the hole in the plate before the cell below it; then level 2.
    const std::array<Position, 3> low{Position{3, -4}, {14, -15}, {10, -5}};
    const std::array<std::int64_t, 3> level{1, 1, 2};
    for (std::size_t i = 0; i < 3; ++i) {
        const Feature& feature = sink.features[rejected][i];
        EXPECT_EQ(sink.value(rejected, i, "id"), FieldValue{static_cast<std::int64_t>(i + 1)});
        EXPECT_EQ(sink.value(rejected, i, "level"), FieldValue{level[i]});
        EXPECT_EQ(sink.value(rejected, i, "building"), FieldValue{});
        EXPECT_EQ(sink.value(rejected, i, "contour"), FieldValue{});
        EXPECT_EQ(sink.number(rejected, i, "area_m2"), 1);
        EXPECT_EQ(sink.number(rejected, i, "perim_m"), 4);
        ASSERT_EQ(feature.parts.size(), 1U);
        const auto [x, y] = low[i];
        EXPECT_EQ(feature.parts[0].exterior, (WorldRing{{x, y + 1}, {x, y}, {x + 1, y}, {x + 1, y + 1}}))
            << i;
    }
}

TEST(Rejected, WhatStandsOnNoiseIsThereToo) {
    // A block of 4 x 4 passes 16 points; an E of ten cells on it passes 22.
    std::vector<double> z(36, 0.0);
    for (int row = 1; row <= 4; ++row)
        for (int col = 1; col <= 4; ++col)
            z[static_cast<std::size_t>(row * 6 + col)] = col == 1 || row == 1 || row == 3 ? 30 : 20;
    MemorySource source(6, 6, z);
    Options options = cells({10, 25});
    options.filter.noise_factor = 17;
    options.write.rejected = true;
    MemorySink sink;
    const RunReport report = run(options, {source}, {sink});
    EXPECT_EQ(reasons(sink), (std::map<std::string, int>{{"contour_short", 1}, {"contour_on_dropped", 1}}));
    EXPECT_EQ(sink.number(rejected, 0, "area_m2"), 16);
    EXPECT_EQ(sink.number(rejected, 1, "area_m2"), 10);
}

TEST(Rejected, OutlinesThatStayAsTracedNameWhatTheyAreOf) {
    TownRun town(MadeTown::slanted());
    town.options.write.rejected = true;
    town.options.levels.lod = 6;
    town.options.filter.noise_factor = 4;
    town.options.outline.wall_tolerance = 0.02;  // no wall comes so near to its trace
    town.run();
    expect_all_are_there(town.sink, town.report);
    int kept = 0;
    for (const std::size_t layer : {buildings, contours})
        for (std::size_t i = 0; i < town.count(layer); ++i) {
            if (town.sink.value(layer, i, "status") != FieldValue{std::string("kept_traced")})
                continue;
            ++kept;
            const char* field = layer == buildings ? "building" : "contour";
            const FieldValue id = town.sink.value(layer, i, "id");
            std::size_t found = 0;
            for (std::size_t k = 0; k < town.count(rejected); ++k)
                if (town.sink.value(rejected, k, field) == id) {
                    ++found;
                    EXPECT_EQ(town.sink.value(rejected, k, "reason"),
                              FieldValue{std::string("outline_kept_traced")});
                }
            EXPECT_EQ(found, 1U) << field << ' ' << i;
        }
    EXPECT_GT(kept, 0);
    EXPECT_EQ(town.report.counted(Reason::outline_kept_traced), kept);
}

/// The parts of a feature agree with its fields.
TEST(FeatureRecords, SayWhatTheFieldsSay) {
    TownRun town(MadeTown::slanted());
    town.options.write.rejected = true;
    town.options.outline.wall_tolerance = 0.02;  // no wall comes so near to its trace
    town.run();
    ASSERT_EQ(town.count(buildings), 3U);
    for (std::size_t i = 0; i < town.count(buildings); ++i) {
        const auto& building = std::get<BuildingRecord>(town.sink.features[buildings][i].record);
        EXPECT_EQ(building.id, town.sink.whole(buildings, i, "id"));
        EXPECT_EQ(building.ground, town.sink.number(buildings, i, "ground"));
        EXPECT_EQ(building.roof, town.sink.number(buildings, i, "roof"));
        EXPECT_EQ(building.area_m2, town.sink.number(buildings, i, "area_m2"));
    }
    for (std::size_t i = 0; i < town.count(contours); ++i) {
        const auto& contour = std::get<ContourRecord>(town.sink.features[contours][i].record);
        EXPECT_EQ(contour.id, town.sink.whole(contours, i, "id"));
        EXPECT_EQ(contour.level, town.sink.whole(contours, i, "level"));
        EXPECT_EQ(contour.base, town.sink.number(contours, i, "base"));
        EXPECT_EQ(contour.top, town.sink.number(contours, i, "top"));
        EXPECT_EQ(contour.area_m2, town.sink.number(contours, i, "area_m2"));
    }
    const std::size_t last = town.sink.features.size() - 1;
    ASSERT_GT(town.count(last), 0U);
    for (std::size_t i = 0; i < town.count(last); ++i)
        EXPECT_EQ(
            FieldValue{std::string(std::get<RejectedRecord>(town.sink.features[last][i].record).reason)},
            town.sink.value(last, i, "reason"));
}

/// A stack from its records alone: no gap, and every contour on one of the level below.
TEST(FeatureRecords, AreEnoughToStackATower) {
    TownRun town;
    town.run();
    std::int64_t with_parent = 0;
    for (const Feature& feature : town.sink.features[contours]) {
        const auto& contour = std::get<ContourRecord>(feature.record);
        EXPECT_LE(contour.base, contour.top);
        if (contour.parent_id == 0)
            continue;
        ++with_parent;
        for (const Feature& other : town.sink.features[contours]) {
            const auto& below = std::get<ContourRecord>(other.record);
            if (below.id != contour.parent_id)
                continue;
            EXPECT_EQ(below.building_id, contour.building_id);
            EXPECT_EQ(below.level, contour.level - 1);
            EXPECT_EQ(below.top, contour.base);
        }
    }
    EXPECT_GT(with_parent, 0);
}

}  // namespace
}  // namespace d2b::test

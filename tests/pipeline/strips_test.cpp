#include "detect/strips.hpp"

#include <map>

#include <gtest/gtest.h>

#include "options/run_plan.hpp"
#include "pipeline/find_buildings.hpp"
#include "pipeline/made_town.hpp"

namespace d2b {
namespace {

using test::MadeTown;

TEST(Strips, ASmallWindowIsOne) {
    const std::vector<Strip> strips = strips_of({100, 7, 1000, 2000}, {1, 1}, 300, {2'000'000, 10});
    ASSERT_EQ(strips.size(), 1U);
    EXPECT_EQ(strips[0].own.end, 1000);
    EXPECT_EQ(strips[0].seen.end, 1000);
}

TEST(Strips, CoverTheWindowAndSeeMore) {
    // 100,000 points in a strip of 100 columns are 1,000 rows, of which 300 lie around its own.
    const std::vector<Strip> strips = strips_of({0, 0, 2100, 100}, {9, 2}, 300, {200'000, 100'000});
    ASSERT_EQ(strips.size(), 3U);
    std::int32_t end = 0;
    for (const Strip& strip : strips) {
        EXPECT_EQ(strip.own.begin, end);
        EXPECT_EQ(strip.own.end - strip.own.begin, 700);
        EXPECT_EQ(strip.seen.begin, std::max(end - 150, 0));
        end = strip.own.end;
        EXPECT_EQ(strip.seen.end, std::min(end + 150, 2100));
    }
    EXPECT_EQ(end, 2100);
}

TEST(Strips, LongRowsHaveSomeAllTheSame) {
    const std::vector<Strip> strips = strips_of({0, 0, 640, 1000}, {1, 1}, 0, {0, 1});
    ASSERT_EQ(strips.size(), 10U);
    EXPECT_EQ(strips[1].own.end - strips[1].own.begin, 64);
    EXPECT_EQ(strips[1].seen.begin, 0);
    EXPECT_EQ(strips[1].seen.end, 192);
}

/// Towns one below the other: 980 x 170 cells.
test::MemorySource tall_town() {
    constexpr int towns = 7;
    std::vector<double> z;
    for (int town = 0; town < towns; ++town) {
        std::vector<double> more = MadeTown::surface();
        for (double& value : more)
            value += 1.4 * town;  // the ground goes on rising
        z.insert(z.end(), more.begin(), more.end());
    }
    return {towns * MadeTown::rows, MadeTown::cols, z};
}

struct Found {
    FoundBuildings buildings;
    std::vector<Label> labels;
    test::MemoryRaster ground;
    Context context;
};

void find(const StripSize& size, bool keep_doubtful, Found& found) {
    test::MemorySource dem = tall_town();
    Options options;
    options.ground.max_building_width = 40;  // strips see 200 rows on either side
    options.write.doubtful = keep_doubtful;
    const RunPlan plan = make_run_plan(options, Layers::both);
    test::MemorySink features;
    found.context.threads = std::make_unique<Executor>(2);
    ElevationReader reader(dem, found.context);
    found.buildings =
        find_buildings(plan, {dem}, {features, &found.ground}, reader, {1, 1}, 1, found.context, size);
    const Window& window = dem.info().window;
    found.labels = found.buildings.band({0, window.rows, window.cols}, 0).labels;
}

class FoundInStrips : public testing::TestWithParam<bool> {};

TEST_P(FoundInStrips, IsWhatIsFoundInTheWhole) {
    Found whole;
    find({}, GetParam(), whole);
    Found strips;
    find({0, 0}, GetParam(), strips);  // of 64 rows: every building is cut somewhere
    ASSERT_EQ(whole.buildings.buildings, 3 * 7);
    EXPECT_EQ(strips.buildings.buildings, whole.buildings.buildings);
    ASSERT_EQ(strips.buildings.count(), whole.buildings.count());
    EXPECT_EQ(strips.context.report.counted(Reason::building_doubtful),
              whole.context.report.counted(Reason::building_doubtful));
    for (const Reason reason : {Reason::building_small, Reason::building_low})
        EXPECT_EQ(strips.context.report.counted(reason), whole.context.report.counted(reason));
    EXPECT_EQ(strips.buildings.fit.cells(), whole.buildings.fit.cells());
    EXPECT_EQ(strips.buildings.fit.bare_share(), whole.buildings.fit.bare_share());
    // The same cells, and one label for each of the other.
    std::map<Label, Label> other;
    for (std::size_t i = 0; i < whole.labels.size(); ++i) {
        const auto [entry, is_new] = other.emplace(whole.labels[i], strips.labels[i]);
        ASSERT_EQ(entry->second, strips.labels[i]) << i / MadeTown::cols << ' ' << i % MadeTown::cols;
    }
    EXPECT_EQ(other[0], 0U);
    for (const auto& [label, same] : other) {
        const Footprint& a = whole.buildings.footprints[label];
        const Footprint& b = strips.buildings.footprints[same];
        EXPECT_EQ(a.confidence, b.confidence);
        EXPECT_EQ(a.doubt, b.doubt);
        if (label != 0) {
            EXPECT_EQ(a.ground, b.ground);
        }
    }
    EXPECT_EQ(strips.ground.row_count, 7 * MadeTown::rows);
    EXPECT_EQ(strips.ground.values, whole.ground.values);
}

INSTANTIATE_TEST_SUITE_P(Doubtful, FoundInStrips, testing::Bool());

}  // namespace
}  // namespace d2b

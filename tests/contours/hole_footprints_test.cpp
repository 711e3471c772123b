#include <gtest/gtest.h>

#include "contours/noise.hpp"
#include "support/trace_grid.hpp"

namespace d2b::contours {
namespace {

using test::trace_plan;
using test::TraceGrid;

/// 10 x 12 cells with a label of 6 x 8 around a courtyard of two cells; a tower of a cell and one of 2 x 3.
TraceGrid court() {
    TraceGrid grid{10, 12, std::vector<double>(120, 0.0), std::vector<Label>(120, 0)};
    for (int row = 2; row <= 7; ++row)
        for (int col = 2; col <= 9; ++col) {
            const auto i = static_cast<std::size_t>(row * 12 + col);
            const bool yard = row == 4 && (col == 5 || col == 6);
            grid.z[i] = yard ? 0 : 10;
            grid.labels[i] = yard ? 0 : 1;
        }
    grid.z[2 * 12 + 2] = 20;
    for (const std::size_t i : {6U * 12 + 7, 6U * 12 + 8, 6U * 12 + 9, 7U * 12 + 7, 7U * 12 + 8, 7U * 12 + 9})
        grid.z[i] = 20;
    return grid;
}

const LevelPlan one_level{0, {{}, {0, 15}}, true};

TEST(KeptFootprints, AreNoNoiseWhateverTheirSize) {
    TraceGrid grid{3, 3, std::vector<double>(9, 0.0), std::vector<Label>(9, 0)};
    grid.z[4] = 10;
    grid.labels[4] = 1;
    Context context;
    const test::ContourSet set = trace_plan(grid, one_level, {TraceMode::cells, 1000, 1000.0}, context);
    ASSERT_EQ(set.buildings.size(), 1U);
    EXPECT_EQ(set.contours[1].squares(), 1);
    EXPECT_EQ(context.report.counted(Reason::contour_short), 0);
    EXPECT_EQ(context.report.counted(Reason::contour_small), 0);
}

TEST(KeptFootprints, KeepTheirHoles) {
    Context context;
    const test::ContourSet set = trace_plan(court(), one_level, {TraceMode::cells, 1000, 1000.0}, context);
    ASSERT_EQ(set.contours.size(), 2U);  // the root and the footprint
    EXPECT_EQ(set.contours[1].interiors.size(), 1U);
    EXPECT_EQ(set.contours[1].squares(), 46);
    EXPECT_EQ(context.report.counted(Reason::hole_short), 0);
    EXPECT_EQ(context.report.counted(Reason::hole_small), 0);
}

TEST(KeptFootprints, HaveNoNoiseOnThem) {
    Context context;
    const test::ContourSet set = trace_plan(court(), one_level, {TraceMode::cells, 10}, context);
    ASSERT_EQ(set.contours.size(), 3U);
    EXPECT_EQ(set.contours[2].squares(), 6);  // a ring of 10 points; that of the other has 4
    EXPECT_EQ(context.report.counted(Reason::contour_short), 1);
    EXPECT_EQ(set.contours[1].own.n, 40);  // its point fell to the footprint
}

TEST(KeptFootprints, HolesAboveThemAreFilled) {
    TraceGrid grid = court();
    grid.labels.assign(120, 0);
    for (int row = 2; row <= 7; ++row)
        for (int col = 2; col <= 9; ++col) {
            const auto i = static_cast<std::size_t>(row * 12 + col);
            grid.labels[i] = 1;
            grid.z[i] = row == 4 && col == 5 ? 10 : 20;  // a pit of a cell in the upper level
        }
    Context context;
    const test::ContourSet set = trace_plan(grid, one_level, {TraceMode::cells, 10}, context);
    ASSERT_EQ(set.contours.size(), 3U);
    EXPECT_EQ(set.contours[2].interiors.size(), 0U);
    EXPECT_EQ(context.report.counted(Reason::hole_short), 1);
}

TEST(KeptFootprints, HolesAroundTheirCourtyardsStay) {
    TraceGrid grid = court();
    for (std::size_t i = 0; i < 120; ++i)
        grid.z[i] = grid.labels[i] == 1 ? 20 : 0;
    Context context;
    const test::ContourSet set = trace_plan(grid, one_level, {TraceMode::cells, 1 + 6}, context);
    ASSERT_EQ(set.contours.size(), 3U);
    EXPECT_EQ(set.contours[2].interiors.size(), 1U);  // short, but the footprint's hole lies in it
}

/// Points of 10 m but for two in ten of 20, above ground at 2.
RoofElevations church() {
    RoofElevations roof;
    roof.percentiles = {10, 10, 19.9949, 20};
    roof.highest = 60;
    return roof;
}

TEST(LowBuildings, AreJudgedByP90AsItIsWritten) {
    const std::vector<double> ground{0, 2, 19.9};
    EXPECT_FALSE(is_too_low(1, church(), {0, ground, 1}));
    EXPECT_FALSE(is_too_low(1, church(), {17.99, ground, 1}));
    EXPECT_TRUE(is_too_low(1, church(), {18, ground, 1}));  // 17.9949, not the spire's 58
    EXPECT_TRUE(is_too_low(2, church(), {0.1, ground, 1}));
    EXPECT_FALSE(is_too_low(1, church(), {5.48, ground, 0.3048}));  // 5.4848 m
    EXPECT_TRUE(is_too_low(1, church(), {5.49, ground, 0.3048}));
    EXPECT_TRUE(is_too_low(1, RoofElevations(), {0.1, ground, 1}));  // no valid point, no height
}

TEST(LowBuildings, GoWithAllThatStandsOnThem) {
    TraceGrid grid = court();  // 46 cells of 10 m, seven of them of 20
    grid.labels[0] = 2;
    grid.z[0] = 19;
    const LevelPlan two{0, {{}, {0, 15}, {0}}, true};
    test::TraceSettings settings{TraceMode::cells};
    settings.keep_roots = false;
    settings.ground = {0, 0, 0};
    settings.min_building_height = 19;
    Context context;
    ASSERT_EQ(trace_plan(grid, two, settings, context).buildings.size(), 2U);  // p90 is 20 and 19
    settings.ground = {0, 2, 0};
    Context other;
    const test::ContourSet set = trace_plan(grid, two, settings, other);
    ASSERT_EQ(set.contours.size(), 1U);
    EXPECT_EQ(set.contours[0].label, 2U);
    EXPECT_EQ(other.report.counted(Reason::building_not_tall), 1);
    EXPECT_EQ(other.report.counted(Reason::contour_on_dropped), 2);
}

TEST(WithoutRoots, FootprintsAreAtTheBottom) {
    TraceGrid grid = court();
    grid.labels[0] = 2;
    grid.z[119] = test::nodata;
    for (int row = 0; row < 10; ++row)  // the root falls apart
        grid.z[static_cast<std::size_t>(row * 12 + 1)] = test::nodata;
    const LevelPlan two{0, {{}, {0, 15}, {0}}, true};
    Context context;
    const test::ContourSet before = trace_plan(grid, two, {TraceMode::cells}, context);
    test::TraceSettings settings{TraceMode::cells};
    settings.keep_roots = false;
    const test::ContourSet set = trace_plan(grid, two, settings, context);
    ASSERT_EQ(before.contours.size(), 2U + 2 + 2);  // roots, footprints, towers
    ASSERT_EQ(set.contours.size(), 4U);
    EXPECT_EQ(set.building, (std::vector<std::int64_t>{0, 1, 1, 1}));
    EXPECT_EQ(set.buildings, (std::vector<std::int64_t>{0, 1}));
    EXPECT_EQ(set.roofs, before.roofs);
    for (std::size_t i = 0; i < set.contours.size(); ++i) {
        EXPECT_EQ(set.contours[i].key, before.contours[i + 2].key);
        EXPECT_EQ(set.contours[i].parent, set.contours[i].key.level == 1 ? -1 : 1);
    }
}

TEST(WithoutRoots, OfGroundAloneNothingIsLeft) {
    Context context;
    test::TraceSettings settings;
    const TraceGrid ground{2, 2, {1, 2, 3, 4}, {0, 0, 0, 0}};
    EXPECT_EQ(trace_plan(ground, {1, {{}}, true}, settings, context).contours.size(), 1U);
    settings.keep_roots = false;
    EXPECT_TRUE(trace_plan(ground, {1, {{}}, true}, settings, context).contours.empty());
}

}  // namespace
}  // namespace d2b::contours

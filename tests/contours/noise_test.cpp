#include "contours/noise.hpp"

#include <gtest/gtest.h>

#include "contours/reference.hpp"
#include "support/random_grid.hpp"

namespace d2b::contours {
namespace {

using test::trace_grid;
using test::TraceGrid;

/// A plate of 9 x 9 with rings of 20 around a pit, and whatever the test puts into it.
TraceGrid plate(double pit) {
    TraceGrid grid{11, 11, std::vector<double>(121, 0.0), {}};
    for (int row = 1; row <= 9; ++row)
        for (int col = 1; col <= 9; ++col)
            grid.z[static_cast<std::size_t>(row * 11 + col)] = 20;
    for (int row = 4; row <= 6; ++row)
        for (int col = 4; col <= 6; ++col)
            grid.z[static_cast<std::size_t>(row * 11 + col)] = pit;
    return grid;
}

TEST(NoiseFactor, LetsPointsFallToTheContourBelow) {
    // A thin tower on a small block.
    TraceGrid grid{6, 6, std::vector<double>(36, 0.0), {}};
    for (const std::size_t i : {14U, 15U, 20U, 21U})
        grid.z[i] = 20;
    grid.z[14] = 30;
    Context context;
    test::ContourSet set = trace_grid(grid, {10, 25}, {TraceMode::cells, 9}, context);
    EXPECT_EQ(set.contours.size(), 1U);
    EXPECT_EQ(context.report.counted(Reason::contour_short), 2);
    EXPECT_EQ(set.contours[0].own.n, 36);
    // A ring of 8 points is kept by a factor of 8; the tower's 4 are not, and its points fall to the block.
    Context other;
    set = trace_grid(grid, {10, 25}, {TraceMode::cells, 8}, other);
    ASSERT_EQ(set.contours.size(), 2U);
    EXPECT_EQ(set.contours[1].own.n, 4);
    EXPECT_EQ(set.contours[1].own.highest, 30);
    EXPECT_EQ(set.contours[0].above.n, 4);
    EXPECT_EQ(other.report.counted(Reason::contour_short), 1);
}

TEST(NoiseFactor, DropsAContourWithAllAboveIt) {
    // A block of 4 x 4 passes 16 points; an E of ten cells on it passes 22.
    TraceGrid grid{6, 6, std::vector<double>(36, 0.0), {}};
    for (int row = 1; row <= 4; ++row)
        for (int col = 1; col <= 4; ++col)
            grid.z[static_cast<std::size_t>(row * 6 + col)] = col == 1 || row == 1 || row == 3 ? 30 : 20;
    Context context;
    EXPECT_EQ(trace_grid(grid, {10, 25}, {TraceMode::cells, 16}, context).contours.size(), 3U);
    const test::ContourSet set = trace_grid(grid, {10, 25}, {TraceMode::cells, 17}, context);
    ASSERT_EQ(set.contours.size(), 1U);
    EXPECT_EQ(context.report.counted(Reason::contour_short), 1);
    EXPECT_EQ(context.report.counted(Reason::contour_on_dropped), 1);
    EXPECT_EQ(set.contours[0].own.n, 36);
    EXPECT_EQ(set.contours[0].above.n, 0);
}

TEST(NoiseFactor, NeverDropsTheRoot) {
    Context context;
    EXPECT_EQ(trace_grid({1, 1, {5}, {}}, {}, {TraceMode::cells, 1000}, context).contours.size(), 1U);
}

TEST(MinArea, KeepsARowOfTreesOutThatManyPointsWouldKeep) {
    // 1 x 20 cells pass 42 lattice points; 4 x 5 cells pass 18.
    TraceGrid grid{10, 24, std::vector<double>(240, 0.0), {}};
    for (int col = 2; col < 22; ++col)
        grid.z[static_cast<std::size_t>(24 + col)] = 20;
    for (int row = 4; row < 8; ++row)
        for (int col = 2; col < 8; ++col)
            grid.z[static_cast<std::size_t>(row * 24 + col)] = 20;
    Context context;
    EXPECT_EQ(trace_grid(grid, {10}, {TraceMode::cells, 20}, context).buildings.size(), 2U);
    const test::ContourSet set = trace_grid(grid, {10}, {TraceMode::cells, 20, 24.0}, context);
    ASSERT_EQ(set.buildings.size(), 1U);
    EXPECT_EQ(set.contours[static_cast<std::size_t>(set.buildings[0])].squares(), 24);
    EXPECT_EQ(context.report.counted(Reason::contour_small), 1);
}

TEST(Holes, ShortOnesAreFilled) {
    Context context;
    // The pit's ring passes 12 points.
    EXPECT_EQ(trace_grid(plate(0), {10}, {TraceMode::cells, 12}, context).contours[1].interiors.size(), 1U);
    EXPECT_EQ(trace_grid(plate(0), {10}, {TraceMode::cells, 13}, context).contours[1].interiors.size(), 0U);
    EXPECT_EQ(context.report.counted(Reason::hole_short), 1);
}

TEST(Holes, SmallOnesAreFilled) {
    Context context;
    EXPECT_EQ(trace_grid(plate(0), {10}, {TraceMode::cells, 0, 9.0}, context).contours[1].interiors.size(),
              1U);
    EXPECT_EQ(trace_grid(plate(0), {10}, {TraceMode::cells, 0, 9.5}, context).contours[1].interiors.size(),
              0U);
    EXPECT_EQ(context.report.counted(Reason::hole_small), 1);
}

TEST(Holes, StayWhereAContourStandsInThem) {
    TraceGrid grid = plate(0);
    grid.z[5 * 11 + 5] = 20;
    Context context;
    // The island passes 4 points, the pit 12: a factor of 13 drops the island, so the pit is filled ...
    EXPECT_EQ(trace_grid(grid, {10}, {TraceMode::cells, 13}, context).contours.size(), 2U);
    EXPECT_EQ(context.report.counted(Reason::hole_short), 1);
    // ... an island that is kept keeps its pit, though both are small by area.
    TraceGrid large{9, 9, std::vector<double>(81, 20.0), {}};
    for (int row = 1; row <= 7; ++row)
        for (int col = 1; col <= 7; ++col)
            large.z[static_cast<std::size_t>(row * 9 + col)] =
                row >= 2 && row <= 6 && col >= 2 && col <= 6 ? 20 : 0;
    const test::ContourSet set = trace_grid(large, {10}, {TraceMode::cells, 0, 25.0}, context);
    ASSERT_EQ(set.contours.size(), 3U);
    EXPECT_EQ(set.contours[1].interiors.size(), 1U);
}

TEST(Holes, StayWhereAHoleOfTheLevelBelowRemains) {
    // NoData in the pit: the root has a hole there. It is as short, so both are filled; with a point of
    // NoData less the root's ring is shorter than the pit's.
    Context context;
    test::ContourSet set = trace_grid(plate(test::nodata), {10}, {TraceMode::cells, 13}, context);
    EXPECT_EQ(set.contours[0].interiors.size(), 0U);
    EXPECT_EQ(set.contours[1].interiors.size(), 0U);
    set = trace_grid(plate(test::nodata), {10}, {TraceMode::cells, 12}, context);
    EXPECT_EQ(set.contours[0].interiors.size(), 1U);
    EXPECT_EQ(set.contours[1].interiors.size(), 1U);
}

TEST(Holes, AZigzagHoleBelowKeepsASmootherOneAboveIt) {
    // Level 0 has a hole of an odd shape (long ring), level 1 the 3 x 3 pit around it (ring of 12).
    TraceGrid grid = plate(5);
    for (const int at : {4 * 11 + 4, 4 * 11 + 6, 5 * 11 + 4, 5 * 11 + 5, 5 * 11 + 6, 6 * 11 + 4, 6 * 11 + 6})
        grid.z[static_cast<std::size_t>(at)] = test::nodata;  // an H: its ring passes 16 points
    Context context;
    const test::ContourSet set = trace_grid(grid, {10}, {TraceMode::cells, 14}, context);
    EXPECT_EQ(set.contours[0].interiors.size(), 1U);
    EXPECT_EQ(set.contours[1].interiors.size(), 1U);
    EXPECT_EQ(context.report.counted(Reason::hole_short), 0);
}

class Nesting : public testing::TestWithParam<unsigned> {};

TEST_P(Nesting, ContoursLieInTheirParentsAndSiblingsAreDisjoint) {
    const test::RandomGridCase c = test::random_grid(GetParam(), 24);
    test::TraceSettings settings{c.mode};
    settings.noise_factor = static_cast<int>(4 + GetParam() % 5 * 4);
    settings.min_area = GetParam() % 3 == 0 ? 3.0 : 0.0;
    Context context;
    const test::ContourSet set = trace_grid(c.grid, c.thresholds, settings, context);
    std::vector<std::set<LatticePoint>> covered(c.thresholds.size() + 1);
    std::vector<std::set<LatticePoint>> squares;
    for (const Contour& contour : set.contours) {
        squares.push_back(test::squares_inside(contour));
        for (const LatticePoint s : squares.back()) {
            EXPECT_TRUE(covered[static_cast<std::size_t>(contour.key.level)].insert(s).second);
            if (contour.parent >= 0) {
                EXPECT_EQ(squares[static_cast<std::size_t>(contour.parent)].count(s), 1U);
            }
        }
        EXPECT_TRUE(contour.key.level == 0 || contour.exterior.points() >= settings.noise_factor);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Nesting, testing::Range(0U, 150U));

}  // namespace
}  // namespace d2b::contours

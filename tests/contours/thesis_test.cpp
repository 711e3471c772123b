#include <gtest/gtest.h>

#include "support/trace_grid.hpp"

namespace d2b::contours {
namespace {

using test::trace_grid;
using test::TraceGrid;

/// The example of Chittineni 2003, figures 4.3 and 4.4: 11 x 7 points, a block of 9 x 5 points of 40 ft.
TraceGrid thesis_example() {
    TraceGrid grid{7, 11, std::vector<double>(77, 0.0), {}};
    for (int row = 1; row <= 5; ++row)
        for (int col = 1; col <= 9; ++col)
            grid.z[static_cast<std::size_t>(row * 11 + col)] = 40;
    return grid;
}

std::vector<int> point_numbers(const LatticeRing& ring) {
    std::vector<int> numbers;
    for (const LatticePoint point : ring)
        numbers.push_back(point.row * 11 + point.col);
    return numbers;
}

TEST(ThesisExample, OneRingOf24PointsThatCompressesToFour) {
    Context context;
    const test::ContourSet set = trace_grid(thesis_example(), {15}, {TraceMode::points}, context);
    ASSERT_EQ(set.contours.size(), 2U);
    const Contour& root = set.contours[0];
    EXPECT_EQ(point_numbers(root.exterior.corners()), (std::vector<int>{0, 66, 76, 10}));
    const Contour& block = set.contours[1];
    EXPECT_EQ(block.exterior.points(), 24);
    // The thesis lists 12, 20, 64, 56 clockwise on the page; exterior rings run counter-clockwise.
    EXPECT_EQ(point_numbers(block.exterior.corners()), (std::vector<int>{12, 56, 64, 20}));
    EXPECT_EQ(block.own.n, 45);
    EXPECT_EQ(block.parent, 0);
    EXPECT_EQ(root.own.n, 77 - 45);
}

TEST(ThesisExample, NoiseFactorCountsUncompressedPoints) {
    Context context;
    EXPECT_EQ(trace_grid(thesis_example(), {15}, {TraceMode::points, 24}, context).contours.size(), 2U);
    EXPECT_EQ(context.report.counted(Reason::contour_short), 0);
    EXPECT_EQ(trace_grid(thesis_example(), {15}, {TraceMode::points, 25}, context).contours.size(), 1U);
    EXPECT_EQ(context.report.counted(Reason::contour_short), 1);
}

TEST(ThesisExample, CellsHaveTheWholeArea) {
    Context context;
    const test::ContourSet set = trace_grid(thesis_example(), {15}, {TraceMode::cells}, context);
    EXPECT_EQ(set.contours[1].squares(), 45);
    EXPECT_EQ(set.contours[1].exterior.points(), 28);
}

TEST(ThesisExample, APointOnTheThresholdDoesNotQualify) {
    Context context;
    EXPECT_EQ(trace_grid(thesis_example(), {40}, {TraceMode::points}, context).contours.size(), 1U);
}

TEST(ThesisExample, AChildMayUseItsParentsPoints) {
    Context context;
    const test::ContourSet set = trace_grid(thesis_example(), {15, 25}, {TraceMode::points}, context);
    ASSERT_EQ(set.contours.size(), 3U);
    EXPECT_EQ(set.contours[2].exterior.corners(), set.contours[1].exterior.corners());
    EXPECT_EQ(set.contours[2].parent, 1);
    EXPECT_EQ(set.contours[1].own.n, 0);
}

TEST(Tracer, WhatIsOnePointWideLeavesNoPolygon) {
    Context context;
    // A wall of one row of points, and a block with a spike of one point.
    const TraceGrid grid{5,
                         6,
                         {0, 0, 0, 0, 0, 0,  //
                          9, 9, 9, 9, 9, 9,  //
                          0, 0, 0, 0, 0, 0,  //
                          9, 9, 9, 0, 0, 0,  //
                          9, 9, 0, 0, 0, 0},
                         {}};
    const test::ContourSet set = trace_grid(grid, {5}, {TraceMode::points}, context);
    ASSERT_EQ(set.contours.size(), 2U);
    EXPECT_EQ(set.contours[1].key.first, (LatticePoint{3, 0}));
    EXPECT_EQ(set.contours[1].squares(), 1);
    EXPECT_EQ(set.contours[1].own.n, 4);
}

TEST(Tracer, ACourtyardThatTouchesTheOutsideInACornerIsAnInteriorRing) {
    Context context;
    const TraceGrid grid{3,
                         3,
                         {9, 9, 0,  //
                          9, 0, 9,  //
                          9, 9, 9},
                         {}};
    const test::ContourSet set = trace_grid(grid, {5}, {TraceMode::cells}, context);
    ASSERT_EQ(set.contours.size(), 2U);
    EXPECT_EQ(set.contours[1].exterior.corners(),
              (LatticeRing{{0, 0}, {3, 0}, {3, 3}, {1, 3}, {1, 2}, {0, 2}}));
    ASSERT_EQ(set.contours[1].interiors.size(), 1U);
    EXPECT_EQ(set.contours[1].interiors[0].corners(), (LatticeRing{{1, 1}, {1, 2}, {2, 2}, {2, 1}}));
}

TEST(Tracer, CellsThatMeetInACornerAreTwoContours) {
    Context context;
    const TraceGrid grid{2, 2, {9, 0, 0, 9}, {}};
    const test::ContourSet set = trace_grid(grid, {5}, {TraceMode::cells}, context);
    EXPECT_EQ(set.contours.size(), 3U);
}

TEST(Tracer, LowestOutsideIsWithinACellOfTheExteriorRing) {
    Context context;
    // The 1 lies diagonally beside the block, the -9 two cells away, the -5 in the courtyard; NaN is nothing.
    TraceGrid grid{7, 7, std::vector<double>(49, 7.0), {}};
    for (const std::size_t i : {16U, 17U, 18U, 23U, 25U, 30U, 31U, 32U})
        grid.z[i] = 20;
    grid.z[24] = -5;
    grid.z[22] = test::nodata;
    grid.z[40] = 1;
    grid.z[0] = grid.z[41] = grid.z[47] = -9;
    const test::ContourSet cells = trace_grid(grid, {10}, {TraceMode::cells}, context);
    ASSERT_EQ(cells.buildings.size(), 1U);
    EXPECT_EQ(cells.contours[static_cast<std::size_t>(cells.buildings[0])].lowest_outside, 1);
}

TEST(Tracer, LowestOutsideOfPoints) {
    Context context;
    const TraceGrid grid{5,
                         6,
                         {5, 5,  5,  5,  5, 5,  //
                          5, 20, 20, 20, 5, 0,  //
                          5, 20, 20, 20, 4, 0,  //
                          3, 20, 20, 20, 5, 0,  //
                          5, 5,  5,  5,  5, 0},
                         {}};
    const test::ContourSet set = trace_grid(grid, {10}, {TraceMode::points}, context);
    ASSERT_EQ(set.buildings.size(), 1U);
    EXPECT_EQ(set.contours[static_cast<std::size_t>(set.buildings[0])].lowest_outside, 3);
}

}  // namespace
}  // namespace d2b::contours

#include <gtest/gtest.h>

#include "ground/connected_ground.hpp"
#include "ground/rank_filter.hpp"
#include "support/test_threads.hpp"

namespace d2b::ground {
namespace {

/// A row of blocks of 2 m; the first is ground, the others exceed their limit.
Grid<std::uint8_t> connected_row(const std::vector<float>& heights, double slope, int steps) {
    AlignedGrid blocks;
    blocks.cell = {2, 2};
    blocks.grid = MetreGrid(1, static_cast<std::int32_t>(heights.size()));
    blocks.grid.values.assign(heights.begin(), heights.end());
    MetreGrid limits(1, blocks.grid.cols, -100.0F);
    limits.at(0, 0) = 100;
    return connected_ground(blocks, limits, slope, steps, test::threads());
}

using Row = std::vector<std::uint8_t>;

TEST(ConnectedGround, GoesUpASlopeAndStopsAtAWall) {
    // Steps of 0.5 m in 2 m are a slope of 0.25; the wall is 3 m high.
    EXPECT_EQ(connected_row({0, 0.5F, 1, 1.5F, 4.5F, 4.5F}, 0.3, 9).values, (Row{1, 1, 1, 1, 0, 0}));
    EXPECT_EQ(connected_row({0, 0.5F, 1, 1.5F, 4.5F, 4.5F}, 0.2, 9).values, (Row{1, 0, 0, 0, 0, 0}));
}

TEST(ConnectedGround, GoesNoFartherThanItsSteps) {
    EXPECT_EQ(connected_row({0, 0, 0, 0, 0}, 0.3, 2).values, (Row{1, 1, 1, 0, 0}));
}

TEST(ConnectedGround, BlocksWithoutAPointConnectNothing) {
    EXPECT_EQ(connected_row({0, 0, no_value, 0}, 0.3, 9).values, (Row{1, 1, 0, 0}));
}

TEST(ConnectedGround, TheWayRoundAWallIsFound) {
    AlignedGrid blocks;
    blocks.cell = {2, 3};
    blocks.grid = MetreGrid(3, 5, 0.0F);
    blocks.grid.at(0, 2) = blocks.grid.at(1, 2) = 9;
    MetreGrid limits(3, 5, -1.0F);
    limits.at(0, 0) = 1;
    const Row expected{1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1};
    EXPECT_EQ(connected_ground(blocks, limits, 0.3, 20, test::threads()).values, expected);
}

}  // namespace
}  // namespace d2b::ground

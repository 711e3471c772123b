#include <limits>

#include <gtest/gtest.h>

#include "diagnose/ground_fit.hpp"

namespace d2b {
namespace {

TEST(GroundSlope, IsToldWhereMostOfItIsSteep) {
    constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
    GroundSlope slope;
    EXPECT_EQ(slope_warning(slope, "p.tif"), "") << "nothing is known";
    slope.add(0.41, 0);
    slope.add(0.3, -0.3);  // 0.42 along its steepest line
    slope.add(not_known, 7);
    slope.add(0.39, 0);
    slope.add(0, 0);
    EXPECT_EQ(slope.cells, 4);
    EXPECT_EQ(slope_warning(slope, "p.tif"), "") << "half of it";
    slope.add(0, -2);
    EXPECT_EQ(
        slope_warning(slope, "p.tif"),
        "60 % of the ground of 'p.tif' is steeper than 40 %, where buildings can hardly be told from the "
        "slope; give a terrain model with -ground, and check the units of elevations and coordinates "
        "(-zunit)");
}

TEST(GroundSlope, IsOfEverySixteenthRowOfItsCells) {
    constexpr std::int32_t rows = 5000;
    constexpr std::int32_t cols = 60;
    MetreGrid ground(rows, cols);
    for (std::int32_t r = 0; r < rows; ++r)
        for (std::int32_t c = 0; c < cols; ++c)
            ground.at(r, c) = static_cast<float>((r + c * c) % 11) * 0.13F;
    GroundSlope slope;
    Executor threads(2);
    add_slope(ground, {1, 1}, 3, {10, 5, rows - 10, cols - 5}, slope, threads);
    std::int64_t cells = 0;
    std::int64_t steep = 0;
    for (std::int32_t r = 10; r < rows - 1; ++r)
        if ((r + 3) % 16 == 0)
            for (std::int32_t c = 5; c < cols - 1; ++c) {
                ++cells;
                const float down = ground.at(r + 1, c) - ground.at(r, c);
                const float across = ground.at(r, c + 1) - ground.at(r, c);
                steep += across * across + down * down > 0.16F ? 1 : 0;
            }
    EXPECT_EQ(slope.cells, cells);
    EXPECT_EQ(slope.steep_cells, steep);
    EXPECT_GT(steep, 0);
    EXPECT_LT(steep, cells);
}

}  // namespace
}  // namespace d2b

#include "diagnose/ground_slope.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace d2b {
namespace {

TEST(GroundSlope, IsToldWhereMostOfItIsSteep) {
    constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
    GroundSlope slope;
    EXPECT_EQ(slope_doubt(slope, "p.tif"), "") << "nothing is known";
    slope.add(0.41, 0);
    slope.add(0.3, -0.3);  // 0.42 along its steepest line
    slope.add(not_known, 7);
    slope.add(0.39, 0);
    slope.add(0, 0);
    EXPECT_EQ(slope.cells, 4);
    EXPECT_EQ(slope_doubt(slope, "p.tif"), "") << "half of it";
    slope.add(0, -2);
    EXPECT_EQ(
        slope_doubt(slope, "p.tif"),
        "60 % of the ground of 'p.tif' is steeper than 40 %, where buildings can hardly be told from the "
        "slope; give a terrain model with -ground, and check the units of elevations and coordinates "
        "(-zunit)");
}

}  // namespace
}  // namespace d2b

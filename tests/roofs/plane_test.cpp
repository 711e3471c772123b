#include "roofs/plane.hpp"

#include <gtest/gtest.h>

namespace d2b::roofs {
namespace {

/// 5 x 5 points of a plane around 0.
PlaneMoments moments(double weight) {
    PlaneMoments sum;
    for (int x = -2; x <= 2; ++x)
        for (int y = -2; y <= 2; ++y)
            sum.add(x, y, 0.3 * x - 0.2 * y + 5, weight);
    return sum;
}

/// The sum of squares of x is 50, to which the prior of a level plane adds 0.01.
TEST(PlaneMoments, FitThePlaneOfExactPoints) {
    const Plane plane = moments(1).fit();
    EXPECT_NEAR(plane.slope_x, 0.3 * 50 / 50.01, 1e-12);
    EXPECT_NEAR(plane.slope_y, -0.2 * 50 / 50.01, 1e-12);
    EXPECT_NEAR(plane.z0, 5, 1e-12);
    EXPECT_NEAR(plane.at(2, -1), 5 + 0.6 + 0.2, 1e-3);
}

/// A point 1 m off the plane through four others costs the part of its square that no plane can take: with
/// x^2, y^2 and the count at 4, 4 and 4, the corner (1, 1) has a leverage of 3/4.
TEST(PlaneMoments, ErrorIsTheSquaredDistanceFromTheBestPlane) {
    PlaneMoments sum;
    for (const auto& [x, y] : {std::pair{-1, -1}, {-1, 1}, {1, -1}, {1, 1}})
        sum.add(x, y, x == 1 && y == 1 ? 1 : 0);
    EXPECT_NEAR(sum.error(), 0.25, 0.002);
    EXPECT_NEAR(moments(1).error(), 0, 0.002);
}

TEST(PlaneMoments, WeightsCountAsPointsDo) {
    PlaneMoments twice = moments(1);
    twice.add(moments(0.5), 2);
    const PlaneMoments heavy = moments(2);
    EXPECT_DOUBLE_EQ(twice.weight(), 50);
    EXPECT_DOUBLE_EQ(heavy.weight(), 50);
    EXPECT_DOUBLE_EQ(twice.fit().slope_x, heavy.fit().slope_x);
    EXPECT_DOUBLE_EQ(twice.fit().z0, heavy.fit().z0);
}

TEST(PlaneMoments, OfNothingAreLevel) {
    const Plane plane = PlaneMoments().fit();
    EXPECT_EQ(plane.slope_x, 0);
    EXPECT_EQ(plane.slope_y, 0);
    EXPECT_EQ(plane.z0, 0);
    EXPECT_EQ(PlaneMoments().error(), 0);
}

TEST(PlaneMoments, OfOnePointAreLevel) {
    PlaneMoments one;
    one.add(3, 4, 7);
    EXPECT_DOUBLE_EQ(one.fit().at(100, 100), 7);
}

}  // namespace
}  // namespace d2b::roofs

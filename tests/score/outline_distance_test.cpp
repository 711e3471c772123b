#include "score/outline_distance.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace d2b {
namespace {

TEST(SquaredDistance, isToTheNearestPointOfASegment) {
    const OutlineSegment segment{{1, 1}, {5, 1}};
    EXPECT_DOUBLE_EQ(squared_distance({3, 4}, segment), 9);
    EXPECT_DOUBLE_EQ(squared_distance({-2, 5}, segment), 25);
    EXPECT_DOUBLE_EQ(squared_distance({6, 0}, segment), 2);
    EXPECT_DOUBLE_EQ(squared_distance({4, 5}, {{1, 1}, {1, 1}}), 25);  // a segment of no length
}

TEST(OutlineDistance, ofParallelLines) {
    const std::vector<Polyline> outline{{{0, 0}, {10, 0}}};
    const std::vector<Polyline> reference{{{-5, 1}, {15, 1}}};
    const OutlineDistance distance = outline_distance(outline, reference, 3, 0.05);
    EXPECT_NEAR(distance.length, 10, 1e-9);
    EXPECT_NEAR(distance.near, 10, 1e-9);
    EXPECT_NEAR(distance.rms.value(), 1, 1e-9);
}

TEST(OutlineDistance, ofALineThatLeavesTheReference) {
    // Distances grow from 0 to 10; those up to 3 count: the mean of their squares is 3.
    const std::vector<Polyline> outline{{{0, 0}, {0, 10}}};
    const std::vector<Polyline> reference{{{-5, 0}, {5, 0}}};
    const OutlineDistance distance = outline_distance(outline, reference, 3, 0.05);
    EXPECT_NEAR(distance.near, 3, 0.05);
    EXPECT_NEAR(distance.rms.value(), std::sqrt(3.0), 0.02);
}

TEST(OutlineDistance, goesToTheNearestOfMany) {
    // Towards a comb of teeth 1 apart: distances along y = 0 run from 0 to 0.5 and back; their mean square is
    // 1/12.
    std::vector<Polyline> comb;
    for (int i = 0; i <= 100; ++i)
        comb.push_back({{static_cast<double>(i), 0}, {static_cast<double>(i), 20}});
    const std::vector<Polyline> outline{{{0, 0.5}, {100, 0.5}}};
    EXPECT_NEAR(outline_distance(outline, comb, 3, 0.01).rms.value(), std::sqrt(1.0 / 12), 1e-4);
}

TEST(OutlineDistance, isTheSameWhateverTheEdgesAreDividedInto) {
    const std::vector<Polyline> reference{{{0, 1}, {30, 2}, {60, 0.5}}};
    Polyline divided;
    for (int i = 0; i <= 600; ++i)
        divided.push_back({i / 10.0, 0});
    const double whole =
        outline_distance(std::vector<Polyline>{{{0, 0}, {60, 0}}}, reference, 3, 0.05).rms.value();
    EXPECT_NEAR(outline_distance(std::vector<Polyline>{divided}, reference, 3, 0.05).rms.value(), whole,
                1e-4);
}

TEST(OutlineDistance, hasNoRmsWhereNothingIsNear) {
    const std::vector<Polyline> outline{{{0, 0}, {10, 0}}};
    const OutlineDistance distance =
        outline_distance(outline, std::vector<Polyline>{{{0, 4}, {10, 4}}}, 3, 0.05);
    EXPECT_NEAR(distance.length, 10, 1e-9);
    EXPECT_EQ(distance.near, 0);
    EXPECT_FALSE(distance.rms);
    EXPECT_FALSE(outline_distance(outline, {}, 3, 0.05).rms);
    EXPECT_FALSE(outline_distance({}, outline, 3, 0.05).rms);
}

TEST(OutlineDistance, countsPointsAtTheLimit) {
    const std::vector<Polyline> outline{{{0, 0}, {10, 0}}};
    EXPECT_NEAR(outline_distance(outline, std::vector<Polyline>{{{-9, 3}, {19, 3}}}, 3, 0.05).rms.value(), 3,
                1e-9);
}

}  // namespace
}  // namespace d2b

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "compare/compare_heights.hpp"
#include "compare/height_grid.hpp"
#include "surveys.hpp"

namespace d2b::test {
namespace {

using namespace compare;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

SurveyedBuilding flat(double height, double area) {
    SurveyedBuilding building;
    building.area_m2 = area;
    building.heights = {{height, height, height, height}, height};
    return building;
}

RoofHeights joint_of(const SurveyedBuilding& one, const SurveyedBuilding& other) {
    const std::array<const SurveyedBuilding*, 2> both{&one, &other};
    return joint_heights(both);
}

TEST(JointHeights, areThoseOfOneBuilding) {
    const SurveyedBuilding one = flat(7, 100);
    const std::array<const SurveyedBuilding*, 1> only{&one};
    EXPECT_EQ(joint_heights(only).p90(), 7);
}

TEST(JointHeights, weighBuildingsByArea) {
    // Half of the points of the second are at 5 to 10 m, evenly, and half at 10 m.
    const RoofHeights heights = joint_of(flat(5, 100), flat(10, 100));
    EXPECT_NEAR(heights.percentiles[0], 5, 1e-3);
    EXPECT_NEAR(heights.percentiles[1], 9, 1e-3);  // 0.5 + 0.5 * 0.5 * (9 - 5) / 5 = 0.7
    EXPECT_NEAR(heights.p90(), 10, 1e-3);
    EXPECT_EQ(heights.highest, 10);
    EXPECT_NEAR(joint_of(flat(5, 950), flat(10, 50)).p90(), 5, 1e-3);
}

TEST(JointHeights, needTheHeightOfEach) {
    SurveyedBuilding unknown;
    unknown.area_m2 = 10;
    EXPECT_TRUE(std::isnan(joint_of(flat(5, 100), unknown).p90()));
    SurveyedBuilding p90_alone = box_building(0, 0, 10, 10, 8);
    EXPECT_NEAR(joint_of(flat(5, 100), p90_alone).p90(), 8, 1e-3);
}

TEST(Rise, isTheMedianOfThreePercentiles) {
    const RoofHeights before{{4, 5, 6, 7}, 8};
    EXPECT_EQ(rise_m(before, {{7, 8, 9, 10}, 11}), 3);
    EXPECT_EQ(rise_m(before, {{4.25, 5.5, 9, 12}, 14}), 0.5);  // a crown over a part of the roof
    EXPECT_EQ(rise_m(before, {{4, 8, 9, 9}, 9}), 3);           // a part of 30 % or more raised
}

TEST(Rise, isThatOfP90WhereOthersAreUnknownOrOutOfOrder) {
    const RoofHeights before{{4, 5, 6, 7}, 8};
    EXPECT_EQ(rise_m(before, {{nan, nan, 9, nan}, nan}), 3);
    EXPECT_EQ(rise_m(before, {{4, 5, 9, 7}, 8}), 3);
    EXPECT_TRUE(std::isnan(rise_m(before, RoofHeights())));
}

TEST(StandsThere, needsHeightsOverHalfOfTheBuilding) {
    const std::vector<double> own{6, 6, 6, 6};
    EXPECT_FALSE(stands_there(own, std::vector<double>{0, 0, 0, 6}, 0.9).stands);
    EXPECT_TRUE(stands_there(own, std::vector<double>{0, 0, 6, 6}, 0.9).stands);
    EXPECT_FALSE(stands_there(own, std::vector<double>{nan, nan, nan, 6}, 0.9).stands);
    EXPECT_FALSE(stands_there({}, {}, 0.5).stands);
}

TEST(StandsThere, tellsTheSameRoofFromATree) {
    const std::vector<double> own{6, 6, 6, 6, 6};
    const StandsThere same = stands_there(own, std::vector<double>{6.5, 5.5, 9, 12, 11}, 0.9);
    EXPECT_TRUE(same.stands);
    EXPECT_EQ(same.rise_m, 0);
    const std::vector<double> tree{8, 10.5, 13, 3, 4.5};
    EXPECT_FALSE(stands_there(own, tree, 0.8).stands);
    const StandsThere doubtful = stands_there(own, tree, 0.79);
    EXPECT_TRUE(doubtful.stands);
    EXPECT_TRUE(std::isnan(doubtful.rise_m));
}

TEST(StandsThere, knowsHowMuchARoofRose) {
    const StandsThere raised =
        stands_there(std::vector<double>{3, 4, 5, 4, 3}, std::vector<double>{6, 7, 8, 12, 6.5}, 0.9);
    EXPECT_TRUE(raised.stands);
    EXPECT_EQ(raised.rise_m, 3);
}

TEST(HeightGrid, hasHeightsOfCells) {
    HeightGrid grid(2, 3, {100, 2, 0, 50, 0, -2});
    grid.set({1, 1, 1, 2}, std::array<float, 2>{3.456F, std::numeric_limits<float>::quiet_NaN()});
    EXPECT_NEAR(grid.at({102.5, 47}), 3.46, 1e-9);
    EXPECT_TRUE(std::isnan(grid.at({104.5, 47})));  // NaN
    EXPECT_TRUE(std::isnan(grid.at({102.5, 49})));  // not written
    for (const Position outside : {Position{99, 47}, {107, 47}, {102.5, 51}, {102.5, 45}})
        EXPECT_TRUE(std::isnan(grid.at(outside)));
}

TEST(HeightGrid, isMovedAndTransformed) {
    HeightGrid grid(1, 1, {0, 1, 0, 1, 0, -1});
    grid.set({0, 0, 1, 1}, std::array<float, 1>{5});
    SurveyHeights heights{grid};
    heights.offset = {10, 20};
    const std::array<Position, 2> places{{{10.5, 20.5}, {0.5, 0.5}}};
    EXPECT_EQ(heights.at(places)[0], 5);
    EXPECT_TRUE(std::isnan(heights.at(places)[1]));
    heights.to_grid = [](std::span<Position> positions) {
        for (Position& p : positions)
            p = {p.x + 10, p.y + 20};
    };
    EXPECT_EQ(heights.at(places)[1], 5);
}

TEST(PositionsIn, leaveHolesOut) {
    const Polygons square{{ring_of_box(0, 0, 4, 4), {}}};
    EXPECT_EQ(positions_in(square, 1).size(), 16U);
    EXPECT_EQ(positions_in(square, 1)[0], (Position{0.5, 0.5}));
    EXPECT_EQ(positions_in({{ring_of_box(0, 0, 4, 4), {ring_of_box(1, 1, 3, 3)}}}, 1).size(), 12U);
    EXPECT_EQ(positions_in(square, 2).size(), 4U);
}

}  // namespace
}  // namespace d2b::test

#include "ground/rules.hpp"

#include <gtest/gtest.h>

#include "ground/estimate.hpp"
#include "ground/scene.hpp"

namespace d2b::ground {
namespace {

Terrain estimated(const test::Scene& scene, const Rules& rules) {
    Context context;
    MetreGrid surface = scene.surface;
    return estimate(surface, scene.cell, GroundOptions{}.max_building_width, context, {}, rules);
}

TEST(GroundRules, CellsOfAMetreHaveTheUsualOnes) {
    for (const double side : {0.1, 0.5, 1.0, 1.2}) {
        const Rules rules = rules_for({side, side});
        EXPECT_EQ(rules.border_reach, Rules().border_reach) << side;
        EXPECT_EQ(rules.small_slope, Rules().small_slope) << side;
        EXPECT_EQ(rules.large_rise, Rules().large_rise) << side;
        EXPECT_EQ(rules.wall_share, Rules().wall_share) << side;
        EXPECT_EQ(rules.plateau_share, Rules().plateau_share) << side;
    }
}

TEST(GroundRules, ChangeEvenlyUpToCellsOfTwoMetres) {
    const Rules fine;
    const Rules coarse = rules_for({2, 2});
    const Rules between = rules_for({1.6, 1.6});
    EXPECT_NEAR(between.border_reach, (fine.border_reach + coarse.border_reach) / 2, 1e-12);
    EXPECT_NEAR(between.small_slope, (fine.small_slope + coarse.small_slope) / 2, 1e-12);
    EXPECT_NEAR(between.large_rise, (fine.large_rise + coarse.large_rise) / 2, 1e-12);
    EXPECT_NEAR(between.wall_share, (fine.wall_share + coarse.wall_share) / 2, 1e-12);
    EXPECT_EQ(rules_for({5, 5}).border_reach, coarse.border_reach);
    // Of cells that are not square, that of a square of the same area.
    EXPECT_EQ(rules_for({1, 4}).border_reach, coarse.border_reach);
}

TEST(GroundRules, ARowOfHousesThatTheBorderCutsIsNoGroundOnCoarseCells) {
    const test::Scene plain(60, 80, {2.5, 2.5});
    test::Scene street = plain;
    street.box({0, 15, 8, 50}, 5);  // 20 m deep, whose alleys no cell shows
    EXPECT_EQ(estimated(street, {}).elevation.at(2, 40), 105);
    const Terrain terrain = estimated(street, rules_for(street.cell));
    for (std::size_t k = 0; k < plain.surface.size(); ++k)
        ASSERT_NEAR(terrain.elevation.values[k], plain.surface.values[k], 1e-3);
}

TEST(GroundRules, WhatSmallSquaresLowerStepByStepIsNoGroundOnCoarseCells) {
    // The square of five cells lowers the middle by 0.85 m, and the one of seven the rest by 1.28 m, where
    // 0.18 times their radii are 0.9 and 1.35 m, and 0.16 times these 0.8 and 1.2 m.
    const test::Scene plain(60, 60, {2.5, 2.5});
    test::Scene house = plain;
    house.box({27, 27, 5, 5}, 1.28F).box({28, 28, 3, 3}, 0.85F);
    EXPECT_NEAR(estimated(house, {}).elevation.at(29, 29), 102.13, 1e-3);
    EXPECT_NEAR(estimated(house, rules_for(house.cell)).elevation.at(29, 29), 100, 1e-3);
}

}  // namespace
}  // namespace d2b::ground

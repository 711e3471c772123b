#include "ground/rules.hpp"

#include <array>

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

/// Those that depend on the cell.
std::array<double, 5> of_cells(const Rules& rules) {
    return {rules.border_reach, rules.small_slope, rules.large_rise, rules.wall_share, rules.plateau_share};
}

TEST(GroundRules, CellsOfAMetreHaveTheUsualOnes) {
    for (const double side : {0.1, 0.5, 1.0, 1.2})
        EXPECT_EQ(of_cells(rules_for({side, side})), of_cells({})) << side;
}

TEST(GroundRules, ChangeEvenlyUpToCellsOfTwoMetres) {
    const std::array<double, 5> fine = of_cells({});
    const std::array<double, 5> coarse = of_cells(rules_for({2, 2}));
    const std::array<double, 5> between = of_cells(rules_for({1.6, 1.6}));
    for (std::size_t k = 0; k < fine.size(); ++k)
        EXPECT_NEAR(between[k], (fine[k] + coarse[k]) / 2, 1e-12) << k;
    EXPECT_EQ(of_cells(rules_for({5, 5})), coarse);
    // Of cells that are not square, those of a square of the same area.
    EXPECT_EQ(of_cells(rules_for({1, 4})), coarse);
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

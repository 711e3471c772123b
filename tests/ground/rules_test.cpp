#include "ground/rules.hpp"

#include <array>

#include <gtest/gtest.h>

#include "ground/ground.hpp"
#include "ground/scene.hpp"

namespace d2b::ground {
namespace {

Terrain estimated(const test::Scene& scene, const Rules& rules) {
    Context context;
    MetreGrid surface = scene.surface;
    return estimate(surface, scene.cell, GroundOptions{}.max_building_width, context, {}, rules);
}

/// Those that depend on the cell.
std::array<double, 6> of_cells(const Rules& rules) {
    return {rules.border_reach, rules.small_slope, rules.border_share,
            rules.large_rise,   rules.wall_share,  rules.plateau_share};
}

TEST(GroundRules, CellsOfAMetreHaveTheUsualOnes) {
    for (const double side : {0.1, 0.5, 1.0, 1.2})
        EXPECT_EQ(of_cells(rules_for({side, side})), of_cells({})) << side;
}

TEST(GroundRules, ChangeEvenlyUpToCellsOfTwoMetres) {
    const std::array<double, 6> fine = of_cells({});
    const std::array<double, 6> coarse = of_cells(rules_for({2, 2}));
    const std::array<double, 6> between = of_cells(rules_for({1.6, 1.6}));
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

TEST(GroundRules, AtTheBorderOfFineCellsLessIsAnObject) {
    // The square of five cells lowers the middle by 0.32 m, and the one of seven the rest by 0.5 m: less than
    // 0.18 times their radii, 0.36 and 0.54 m, but more than three quarters of these, 0.27 and 0.405 m.
    const test::Scene plain(60, 60, {1, 1});
    const auto middle_at = [&](std::int32_t row, std::int32_t col) {
        test::Scene shed = plain;
        shed.box({row - 2, col - 2, 5, 5}, 0.5F).box({row - 1, col - 1, 3, 3}, 0.32F);
        return estimated(shed, {}).elevation.at(row, col);
    };
    EXPECT_NEAR(middle_at(30, 30), 100.82, 1e-3);
    for (const std::int32_t beside : {9, 50}) {
        EXPECT_NEAR(middle_at(beside, 30), 100, 1e-3) << beside;
        EXPECT_NEAR(middle_at(30, beside), 100, 1e-3) << beside;
    }
    EXPECT_NEAR(middle_at(14, 30), 100.82, 1e-3) << "12 m from the border";
}

TEST(GroundRules, AtTheBorderLessIsALargeObjectAsWell) {
    // A roof of 20 m and 1.1 m is lowered by an element with a radius between 10 and 14 m: its limit is 1.2
    // to 1.4 m, at the border 0.9 to 1.05 m.
    const test::Scene plain(100, 100, {1, 1});
    const auto middle_at = [&](std::int32_t row) {
        test::Scene roof = plain;
        roof.box({row - 10, 40, 20, 20}, 1.1F);
        return estimated(roof, {}).elevation.at(row, 50);
    };
    EXPECT_NEAR(middle_at(50), 101.1, 1e-3);
    EXPECT_NEAR(middle_at(14), 100, 1e-3);
}

}  // namespace
}  // namespace d2b::ground

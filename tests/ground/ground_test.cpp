#include "ground/ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "ground/rules.hpp"
#include "ground/scene.hpp"

namespace d2b::ground {
namespace {

using test::Scene;

/// The greatest distance of the terrain from a scene's ground.
double worst(const Terrain& terrain, const Scene& ground) {
    double found = 0;
    for (std::size_t k = 0; k < terrain.elevation.size(); ++k)
        found = std::max(
            found, static_cast<double>(std::fabs(terrain.elevation.values[k] - ground.surface.values[k])));
    return found;
}

TEST(Ground, BoxesOnFlatGroundAreTakenOff) {
    const Scene ground(240, 300, {0.5, 0.5});
    Scene city = ground;
    city.box({40, 50, 30, 20}, 3).box({150, 100, 60, 160}, 25).box({100, 20, 3, 3}, 2);
    const Terrain terrain = city.terrain();
    EXPECT_LT(worst(terrain, ground), 1e-4);
    EXPECT_EQ(terrain.flags.at(60, 60), 0);
    EXPECT_EQ(terrain.flags.at(5, 5), bare_ground);
}

TEST(Ground, BoxesOnAHillsideLeaveTheHillside) {
    const Scene ground(400, 400, {0.5, 0.5}, 0.15, -0.1);
    Scene city = ground;
    city.box({100, 100, 30, 40}, 8).box({250, 200, 40, 30}, 6);
    const Terrain terrain = city.terrain();
    for (std::int32_t i = 0; i < 400; ++i)
        for (std::int32_t j = 0; j < 400; ++j)
            if (city.surface.at(i, j) == ground.surface.at(i, j)) {
                ASSERT_NEAR(terrain.elevation.at(i, j), ground.surface.at(i, j), 1e-3) << i << " " << j;
            }
    EXPECT_LT(worst(terrain, ground), 1);
}

TEST(Ground, ABuildingWiderThanTheOptionIsTakenOffFlatGround) {
    const Scene ground(300, 300, {1, 1});
    Scene city = ground;
    city.box({100, 90, 100, 110}, 12);
    EXPECT_LT(worst(city.terrain(), ground), 1e-4);
}

TEST(Ground, TheOptionSaysHowWide) {
    const Scene ground(400, 400, {1, 1});
    Scene city = ground;
    city.box({130, 130, 140, 140}, 12);
    // Structuring elements reach up to 1.5 times the width to each side, the widest of them at least 1.5
    // / 1.4 times: 150 m in all at 70 m, 30 m at 10 m.
    for (const double width : {70, 140})
        EXPECT_LT(worst(city.terrain(width), ground), 1e-4) << width;
    EXPECT_EQ(city.terrain(10).elevation.at(200, 200), 112);
}

TEST(Ground, AHillIsGround) {
    Scene hill(400, 400, {1, 1});
    for (std::int32_t i = 0; i < 400; ++i)
        for (std::int32_t j = 0; j < 400; ++j)
            hill.surface.at(i, j) += static_cast<float>(
                15 * std::exp(-(std::pow(i - 200, 2) + std::pow(j - 200, 2)) / (2 * 60.0 * 60.0)));
    const Terrain terrain = hill.terrain();
    EXPECT_LT(worst(terrain, hill), 1.5);
    const auto bare = std::count(terrain.flags.values.begin(), terrain.flags.values.end(), bare_ground);
    EXPECT_GT(bare, 150000);
}

TEST(Ground, ATerraceIsGroundUpToItsEdge) {
    Scene terrace(200, 200, {1, 1});
    for (std::int32_t i = 0; i < 200; ++i)
        for (std::int32_t j = 100; j < 200; ++j)
            terrace.surface.at(i, j) += 6;
    const Terrain terrain = terrace.terrain();
    for (std::int32_t i = 20; i < 180; ++i) {
        EXPECT_EQ(terrain.elevation.at(i, 99), 100);
        EXPECT_EQ(terrain.elevation.at(i, 103), 106);
    }
}

constexpr Scene::Window ramp_hall{100, 120, 60, 100};

/// A hall of 100 m x 60 m, 6 m high, and a ramp to its roof that rises by a fifth.
Scene hall_with_ramp(std::int32_t width) {
    Scene city(300, 300, {1, 1});
    city.box(ramp_hall, 6);
    for (std::int32_t j = 91; j < ramp_hall.col; ++j)
        city.box({120, j, width, 1}, 0.2F * static_cast<float>(j - 90));
    return city;
}

void expect_no_ground_on_the_hall(const Terrain& terrain) {
    for (std::int32_t i = ramp_hall.row; i < ramp_hall.row + ramp_hall.rows; ++i)
        for (std::int32_t j = ramp_hall.col; j < ramp_hall.col + ramp_hall.cols; ++j) {
            ASSERT_NEAR(terrain.elevation.at(i, j), 100, 0.5) << i << " " << j;
            ASSERT_EQ(terrain.flags.at(i, j), 0) << i << " " << j;
        }
}

TEST(Ground, ARoofReachedByANarrowRampIsNone) {
    expect_no_ground_on_the_hall(hall_with_ramp(3).terrain());
}

TEST(Ground, ARoofReachedByAWideRampIsNone) {
    Scene city = hall_with_ramp(20);
    expect_no_ground_on_the_hall(city.terrain());
    // It is its walls that tell: no share is more than one.
    Rules rules;
    rules.wall_share = 1;
    rules.level_share = 1;
    const Terrain connected =
        estimate(city.surface, city.cell, GroundOptions{}.max_building_width, Context(), {}, rules);
    EXPECT_EQ(connected.elevation.at(130, 170), 106);
    EXPECT_EQ(connected.flags.at(130, 170), bare_ground);
}

/// A mound of 10 m whose sides are as steep as `slope`, with a level top of 30 m.
Scene mound(double slope, CellSize cell) {
    Scene scene(static_cast<std::int32_t>(240 / cell.down), static_cast<std::int32_t>(240 / cell.across),
                cell);
    for (std::int32_t i = 0; i < scene.surface.rows; ++i)
        for (std::int32_t j = 0; j < scene.surface.cols; ++j) {
            const double from_middle =
                std::max(std::fabs((i + 0.5) * cell.down - 120), std::fabs((j + 0.5) * cell.across - 120));
            scene.surface.at(i, j) +=
                static_cast<float>(std::clamp(10 - slope * (from_middle - 15), 0.0, 10.0));
        }
    return scene;
}

TEST(Ground, AMoundIsGroundWhereItRisesByLessThanHalfAWallFromBlockToBlock) {
    // Blocks of 2 m: by 0.74 m, and by 0.8 m.
    EXPECT_EQ(mound(0.37, {1, 1}).terrain().elevation.at(120, 120), 110);
    EXPECT_LT(mound(0.40, {1, 1}).terrain().elevation.at(120, 120), 105);
    // Blocks of 3 m: by 0.72 m, and by 1.11 m.
    EXPECT_EQ(mound(0.24, {3, 3}).terrain().elevation.at(40, 40), 110);
    EXPECT_LT(mound(0.37, {3, 3}).terrain().elevation.at(40, 40), 105);
}

TEST(Ground, ABridgeIsNone) {
    Scene valley(200, 200, {1, 1});
    for (std::int32_t i = 0; i < 200; ++i)
        for (std::int32_t j = 80; j < 120; ++j)
            if (i < 95 || i >= 103)
                valley.surface.at(i, j) -= 6;
    const Terrain terrain = valley.terrain();
    EXPECT_NEAR(terrain.elevation.at(99, 100), 94, 0.2);
    EXPECT_EQ(terrain.elevation.at(99, 60), 100);
    EXPECT_EQ(terrain.elevation.at(50, 100), 94);
    EXPECT_EQ(terrain.flags.at(99, 100), 0);
}

TEST(Ground, GroundInWholeMetresStaysAsItIs) {
    Scene steps(300, 300, {0.61, 0.61}, 0.04, 0.02);
    for (float& z : steps.surface.values)
        z = std::floor(z);
    Scene city = steps;
    city.box({100, 100, 50, 60}, 9);
    // A step's corner may be cut by its own height; nothing more is lost, and hardly any of it.
    const Terrain terrain = city.terrain();
    EXPECT_LE(worst(terrain, steps), 1.001);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < steps.surface.size(); ++k)
        kept += std::fabs(terrain.elevation.values[k] - steps.surface.values[k]) < 0.5F ? 1U : 0U;
    EXPECT_GT(kept, steps.surface.size() * 97 / 100);
}

TEST(Ground, TheTerrainIsNeverAboveTheSurface) {
    Scene city(150, 150, {1, 1}, 0.1, 0.05);
    unsigned noise = 1;
    for (float& z : city.surface.values) {
        noise = noise * 1664525U + 1013904223U;
        z += static_cast<float>(noise >> 24) * 0.03F;
    }
    const Terrain terrain = city.terrain();
    for (std::size_t k = 0; k < city.surface.size(); ++k)
        if (!(terrain.flags.values[k] & low_outlier)) {
            ASSERT_LE(terrain.elevation.values[k], city.surface.values[k]);
        }
}

TEST(Ground, CellsMayBeLongerThanWide) {
    const Scene ground(200, 320, {0.5, 0.8});
    Scene city = ground;
    city.box({60, 80, 30, 100}, 5);
    EXPECT_LT(worst(city.terrain(), ground), 1e-4);
}

TEST(GroundEdges, OnePointIsItsOwnGround) {
    const Terrain terrain = Scene(1, 1, {1, 1}).terrain();
    EXPECT_EQ(terrain.elevation.values, std::vector<float>{100});
    EXPECT_EQ(terrain.flags.values, std::vector<std::uint8_t>{bare_ground});
}

TEST(GroundEdges, OneRowOrColumnLosesItsBox) {
    Scene row(1, 200, {1, 1});
    row.box({0, 80, 1, 20}, 8);
    EXPECT_EQ(row.terrain().elevation.values, std::vector<float>(200, 100.0F));
    Scene column(200, 1, {1, 1});
    column.box({80, 0, 20, 1}, 8);
    EXPECT_EQ(column.terrain().elevation.values, std::vector<float>(200, 100.0F));
}

TEST(GroundEdges, NoPointsNoGround) {
    const Terrain terrain = Scene(0, 0, {1, 1}).terrain();
    EXPECT_EQ(terrain.elevation.size(), 0U);
    Scene empty(7, 5, {1, 1});
    for (float& z : empty.surface.values)
        z = test::nan;
    const Terrain none = empty.terrain();
    ASSERT_EQ(none.elevation.size(), 35U);
    for (const float z : none.elevation.values)
        EXPECT_TRUE(std::isnan(z));
    EXPECT_EQ(std::accumulate(none.flags.values.begin(), none.flags.values.end(), 0), 0);
}

TEST(GroundEdges, ALakeWithoutPointsIsFilledFromItsShore) {
    Scene lake(220, 260, {0.5, 0.5});
    for (std::int32_t i = 60; i < 160; ++i)
        for (std::int32_t j = 50; j < 200; ++j)
            lake.surface.at(i, j) = test::nan;
    lake.box({20, 100, 30, 60}, 7);
    for (const float z : lake.terrain().elevation.values)
        ASSERT_NEAR(z, 100, 1e-3);
}

TEST(GroundEdges, ALowOutlierIsFlaggedAndDragsNothingDown) {
    Scene city(200, 200, {0.5, 0.5});
    city.surface.at(77, 91) = 60;
    const Terrain terrain = city.terrain();
    for (std::int32_t i = 0; i < 200; ++i)
        for (std::int32_t j = 0; j < 200; ++j) {
            ASSERT_NEAR(terrain.elevation.at(i, j), 100, 1e-3);
            ASSERT_EQ(terrain.flags.at(i, j), i == 77 && j == 91 ? low_outlier : bare_ground);
        }
}

TEST(GroundEdges, TheCallerMayStop) {
    Context context;
    context.on_progress = [](double) { return false; };
    MetreGrid surface(5, 5, 1.0F);
    EXPECT_THROW(static_cast<void>(estimate_ground(surface, {1, 1}, {}, context)), Cancelled);
}

/// A town on rolling ground: its height at a place depends on the place alone.
Scene town(std::int32_t side) {
    Scene scene(side, side, {2, 2});
    std::mt19937 random(5);
    for (std::int32_t i = 0; i < side; ++i)
        for (std::int32_t j = 0; j < side; ++j)
            scene.surface.at(i, j) += static_cast<float>(9 * std::sin(i * 0.011) * std::cos(j * 0.017)) +
                                      static_cast<float>(random() % 100) * 0.002F;
    for (int n = 0; n < side / 2; ++n)
        scene.box(
            {static_cast<std::int32_t>(random() % static_cast<unsigned>(side - 20)),
             static_cast<std::int32_t>(random() % static_cast<unsigned>(side - 20)),
             static_cast<std::int32_t>(3 + random() % 16), static_cast<std::int32_t>(3 + random() % 16)},
            static_cast<float>(3 + random() % 9));
    return scene;
}

TEST(GroundEdges, BeyondItsSupportACutChangesNothing) {
    constexpr double width = 5;
    const Scene whole = town(700);
    GroundOptions options;
    options.max_building_width = width;
    const auto support = static_cast<std::int32_t>(std::ceil(ground_halo(whole.cell, options) / 2));
    ASSERT_LT(support, 600);
    constexpr std::int32_t row = 37, col = 51;
    Scene part(700 - row, 700 - col, whole.cell);
    for (std::int32_t i = row; i < 700; ++i)
        for (std::int32_t j = col; j < 700; ++j)
            part.surface.at(i - row, j - col) = whole.surface.at(i, j);
    const Terrain of_whole = whole.terrain(width, {1000, 2001});
    const Terrain of_part = part.terrain(width, {1000 + row, 2001 + col});
    for (std::int32_t i = row + support; i < 700; ++i)
        for (std::int32_t j = col + support; j < 700; ++j) {
            ASSERT_EQ(of_part.elevation.at(i - row, j - col), of_whole.elevation.at(i, j)) << i << " " << j;
            ASSERT_EQ(of_part.flags.at(i - row, j - col), of_whole.flags.at(i, j)) << i << " " << j;
        }
}

Terrain estimated(const test::Scene& scene, const Rules& rules) {
    Context context;
    MetreGrid surface = scene.surface;
    return estimate(surface, scene.cell, GroundOptions{}.max_building_width, context, {}, rules);
}

/// Those that depend on the cell.
std::array<double, 7> of_cells(const Rules& rules) {
    return {rules.border_reach, rules.small_slope, rules.border_share, rules.large_rise,
            rules.wall_share,   rules.level_share, rules.plateau_share};
}

TEST(GroundRules, CellsOfAMetreHaveTheUsualOnes) {
    for (const double side : {0.1, 0.5, 1.0, 1.2})
        EXPECT_EQ(of_cells(rules_for({side, side})), of_cells({})) << side;
}

TEST(GroundRules, ChangeEvenlyUpToCellsOfTwoMetres) {
    const std::array<double, 7> fine = of_cells({});
    const std::array<double, 7> coarse = of_cells(rules_for({2, 2}));
    const std::array<double, 7> between = of_cells(rules_for({1.6, 1.6}));
    for (std::size_t k = 0; k < fine.size(); ++k)
        EXPECT_NEAR(between[k], (fine[k] + coarse[k]) / 2, 1e-12) << k;
    EXPECT_EQ(of_cells(rules_for({5, 5})), coarse);
    // Rules for cells that are not square are those of a square of the same area.
    EXPECT_EQ(of_cells(rules_for({1, 4})), coarse);
}

TEST(GroundRules, ARowOfHousesThatTheBorderCutsIsNoGroundOnCoarseCells) {
    const test::Scene plain(60, 80, {2.5, 2.5});
    test::Scene street = plain;
    street.box({0, 15, 8, 50}, 5);  // 20 m deep, whose alleys no cell shows
    Rules fine;
    fine.level_share = 1;
    EXPECT_EQ(estimated(street, fine).elevation.at(2, 40), 105);
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

#include "ground/ground.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "ground/scene.hpp"

namespace d2b {
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

constexpr Scene::Window hall{100, 120, 60, 100};

/// A hall of 100 m x 60 m, 6 m high, and a ramp to its roof that rises by a fifth.
Scene hall_with_ramp(std::int32_t width) {
    Scene city(300, 300, {1, 1});
    city.box(hall, 6);
    for (std::int32_t j = 91; j < hall.col; ++j)
        city.box({120, j, width, 1}, 0.2F * static_cast<float>(j - 90));
    return city;
}

void expect_no_ground_on_the_hall(const Terrain& terrain) {
    for (std::int32_t i = hall.row; i < hall.row + hall.rows; ++i)
        for (std::int32_t j = hall.col; j < hall.col + hall.cols; ++j) {
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
    ground::Rules rules;
    rules.wall_share = 1;
    const Terrain connected =
        ground::estimate(city.surface, city.cell, GroundOptions{}.max_building_width, Context(), {}, rules);
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

}  // namespace
}  // namespace d2b

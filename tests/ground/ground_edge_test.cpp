#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "ground/scene.hpp"

namespace d2b {
namespace {

using test::Scene;

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

/// A town on rolling ground: what it holds at a place depends on the place alone.
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

}  // namespace
}  // namespace d2b

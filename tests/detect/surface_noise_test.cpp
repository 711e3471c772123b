#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "detect/surface_quality.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

MetreGrid noisy_plane(float deviation) {
    std::mt19937 random(7);  // NOLINT: the same noise in every run
    std::normal_distribution<float> noise(0, deviation);
    MetreGrid surface(200, 200);
    for (std::int32_t r = 0; r < surface.rows; ++r)
        for (std::int32_t c = 0; c < surface.cols; ++c)
            surface.at(r, c) = 100 + 0.1F * static_cast<float>(c) + noise(random);
    return surface;
}

}  // namespace

TEST(SurfaceNoise, IsTheStandardDeviationOnOpenGround) {
    for (const float deviation : {0.02F, 0.1F, 0.4F})
        EXPECT_NEAR(surface_noise(noisy_plane(deviation), Mask(200, 200), test::threads()),
                    static_cast<double>(deviation), 0.03 * static_cast<double>(deviation));
}

TEST(SurfaceNoise, WhatIsElevatedOrNotValidDoesNotCount) {
    MetreGrid surface = noisy_plane(0.05F);
    Mask elevated(200, 200);
    for (std::int32_t r = 0; r < 200; ++r)
        for (std::int32_t c = 0; c < 120; ++c) {
            surface.at(r, c) += (r + c) % 2 == 0 ? 5.0F : 0.0F;
            elevated.at(r, c) = 1;
        }
    for (std::int32_t r = 0; r < 200; r += 3)
        surface.at(r, 150) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NEAR(surface_noise(surface, elevated, test::threads()), 0.05, 0.003);
}

TEST(SurfaceNoise, AFewRoughCellsDoNotMoveIt) {
    MetreGrid surface = noisy_plane(0.05F);
    for (std::int32_t r = 0; r < 200; r += 10)
        for (std::int32_t c = 0; c < 200; c += 10)
            surface.at(r, c) += 1.5F;
    EXPECT_NEAR(surface_noise(surface, Mask(200, 200), test::threads()), 0.05, 0.004);
}

TEST(SurfaceNoise, GardensOnHalfOfTheGroundMoveItLittle) {
    MetreGrid surface = noisy_plane(0.05F);
    std::mt19937 random(3);  // NOLINT: the same shrubs in every run
    for (std::int32_t r = 0; r < 200; r += 2)
        for (std::int32_t c = 0; c < 200; ++c)
            surface.at(r, c) += static_cast<float>(random() % 100) / 100;
    // What 0.1 to 0.2 of all cells bend less than, 0.2 to 0.4 of those without shrubs do: of a normal
    // distribution that is 0.25 to 0.52 deviations in place of 0.13 to 0.25. The median would be beyond all
    // of these cells.
    const double noise = surface_noise(surface, Mask(200, 200), test::threads());
    EXPECT_GT(noise, 0.05);
    EXPECT_LT(noise, 0.11);
}

TEST(SurfaceNoise, ZeroWhereValuesAreRoundedOrThereIsNoGround) {
    MetreGrid rounded = noisy_plane(0.05F);
    for (float& z : rounded.values)
        z = std::round(z);
    EXPECT_EQ(surface_noise(rounded, Mask(200, 200), test::threads()), 0.0);
    EXPECT_EQ(surface_noise(noisy_plane(0.05F), Mask(200, 200, 1), test::threads()), 0.0);
    EXPECT_EQ(surface_noise(MetreGrid(20, 20), Mask(20, 20), test::threads()), 0.0);
    EXPECT_EQ(surface_noise(MetreGrid(), Mask(), test::threads()), 0.0);
}

}  // namespace d2b

#include "detect/surface_quality.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "detect/smoothness.hpp"
#include "support/test_threads.hpp"

namespace d2b::detect {
namespace {

using namespace test;

/// Crowns all over, as a scan sees them from which a share of the cells got no point: those take the height
/// of a neighbour that got one.
MetreGrid crowns(double filled, double rounded_to = 0) {
    std::mt19937 random(5);  // NOLINT: the same crowns in every run
    std::uniform_real_distribution<float> height(5, 15);
    std::uniform_real_distribution<double> chance(0, 1);
    MetreGrid surface(300, 300);
    Mask empty(300, 300);
    for (std::size_t i = 0; i < surface.size(); ++i) {
        surface.values[i] = height(random);
        if (rounded_to > 0)
            surface.values[i] = static_cast<float>(
                std::round(static_cast<double>(surface.values[i]) / rounded_to) * rounded_to);
        empty.values[i] = chance(random) < filled ? 1 : 0;
    }
    for (std::int32_t r = 1; r < 299; ++r)
        for (std::int32_t c = 1; c < 299; ++c)
            for (const auto& [down, right] : {std::pair{0, -1}, {-1, 0}, {0, 1}, {1, 0}})
                if (empty.at(r, c) == 1 && empty.at(r + down, c + right) == 0) {
                    surface.at(r, c) = surface.at(r + down, c + right);
                    break;
                }
    return surface;
}

double share_of(const MetreGrid& surface, std::uint8_t elevated = 1) {
    return interpolated_fraction(surface, Mask(surface.rows, surface.cols, elevated),
                                 Grid<std::uint8_t>(surface.rows, surface.cols), threads());
}

TEST(InterpolatedFraction, IsThatOfTheCellsThatTookANeighboursHeight) {
    EXPECT_EQ(share_of(crowns(0)), 0.0);
    for (const double filled : {0.05, 0.1, 0.2, 0.35})
        EXPECT_NEAR(share_of(crowns(filled)), filled, 0.25 * filled) << filled;
}

TEST(InterpolatedFraction, WhatIsEqualByChanceDoesNotCount) {
    // Of 101 heights that are 10 cm apart one in a hundred pairs is equal.
    EXPECT_EQ(share_of(crowns(0, 0.1)), 0.0);
    EXPECT_NEAR(share_of(crowns(0.2, 0.1)), 0.2, 0.05);
    // Of eleven whole metres one in eleven is: nothing can be said.
    EXPECT_EQ(share_of(crowns(0.05, 1)), 0.0);
}

TEST(InterpolatedFraction, LooksAtWhatIsElevatedRoughAndValid) {
    MetreGrid surface = crowns(0.2);
    EXPECT_EQ(share_of(surface, 0), 0.0);
    const Grid<std::uint8_t> smooth(300, 300, smooth_enough);
    EXPECT_EQ(interpolated_fraction(surface, Mask(300, 300, 1), smooth, threads()), 0.0);
    const double expected = share_of(surface);
    MetreGrid wider(300, 400, 7.0F);
    Mask elevated(300, 400);
    for (std::int32_t r = 0; r < 300; ++r)
        for (std::int32_t c = 0; c < 300; ++c) {
            wider.at(r, c) = surface.at(r, c);
            elevated.at(r, c) = 1;
        }
    const Grid<std::uint8_t> rough(300, 400);
    EXPECT_EQ(interpolated_fraction(wider, elevated, rough, threads()), expected);
    for (std::int32_t r = 0; r < 300; ++r)
        for (std::int32_t c = 300; c < 400; ++c) {
            wider.at(r, c) = std::numeric_limits<float>::quiet_NaN();
            elevated.at(r, c) = 1;
        }
    EXPECT_EQ(interpolated_fraction(wider, elevated, rough, threads()), expected);
}

TEST(RoughDifferences, CountsEachPairOfAWindowOnce) {
    std::mt19937 random(3);  // NOLINT: the same masks in every run
    for (const std::int32_t cols : {1, 2, 63, 64, 65, 130}) {
        MetreGrid surface(5, cols);
        Mask elevated(5, cols);
        const Grid<std::uint8_t> flags(5, cols);
        for (std::size_t i = 0; i < surface.size(); ++i) {
            surface.values[i] = static_cast<float>(random() % 8);
            elevated.values[i] = random() % 4 == 0 ? 0 : 1;
        }
        for (const Window& own : {Window{0, 0, 5, cols}, Window{1, cols / 3, 2, (cols + 1) / 2}}) {
            HeightDifferences expected;
            for (std::int32_t r = own.row; r < own.end_row(); ++r)
                for (std::int32_t c = own.col; c < own.end_col(); ++c)
                    for (const std::int32_t down : {0, 1})
                        if (elevated.at(r, c) != 0 && elevated.holds(r + down, c + 1 - down) &&
                            elevated.at(r + down, c + 1 - down) != 0)
                            add_difference(std::abs(surface.at(r, c) - surface.at(r + down, c + 1 - down)),
                                           expected);
            const HeightDifferences found = rough_differences(surface, elevated, flags, own, threads());
            EXPECT_EQ(found.all, expected.all) << cols;
            EXPECT_EQ(found.counts, expected.counts) << cols;
        }
    }
}

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
        EXPECT_NEAR(surface_noise(noisy_plane(deviation), Mask(200, 200), threads()),
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
    EXPECT_NEAR(surface_noise(surface, elevated, threads()), 0.05, 0.003);
}

TEST(SurfaceNoise, AFewRoughCellsDoNotMoveIt) {
    MetreGrid surface = noisy_plane(0.05F);
    for (std::int32_t r = 0; r < 200; r += 10)
        for (std::int32_t c = 0; c < 200; c += 10)
            surface.at(r, c) += 1.5F;
    EXPECT_NEAR(surface_noise(surface, Mask(200, 200), threads()), 0.05, 0.004);
}

TEST(SurfaceNoise, GardensOnHalfOfTheGroundMoveItLittle) {
    MetreGrid surface = noisy_plane(0.05F);
    std::mt19937 random(3);  // NOLINT: the same shrubs in every run
    for (std::int32_t r = 0; r < 200; r += 2)
        for (std::int32_t c = 0; c < 200; ++c)
            surface.at(r, c) += static_cast<float>(random() % 100) / 100;
    // The quantiles 0.1 to 0.2 of all bends are 0.2 to 0.4 of those without shrubs: of a normal
    // distribution that is 0.25 to 0.52 deviations in place of 0.13 to 0.25. The median would be beyond all
    // of these cells.
    const double noise = surface_noise(surface, Mask(200, 200), threads());
    EXPECT_GT(noise, 0.05);
    EXPECT_LT(noise, 0.11);
}

TEST(SurfaceNoise, ZeroWhereValuesAreRoundedOrThereIsNoGround) {
    MetreGrid rounded = noisy_plane(0.05F);
    for (float& z : rounded.values)
        z = std::round(z);
    EXPECT_EQ(surface_noise(rounded, Mask(200, 200), threads()), 0.0);
    EXPECT_EQ(surface_noise(noisy_plane(0.05F), Mask(200, 200, 1), threads()), 0.0);
    EXPECT_EQ(surface_noise(MetreGrid(20, 20), Mask(20, 20), threads()), 0.0);
    EXPECT_EQ(surface_noise(MetreGrid(), Mask(), threads()), 0.0);
}

namespace {

/// Hills with houses and some noise, metres.
MetreGrid hills(double base = 0) {
    MetreGrid surface(120, 150);
    std::mt19937 random(3);
    for (int r = 0; r < surface.rows; ++r)
        for (int c = 0; c < surface.cols; ++c) {
            const double noise = 0.1 * (static_cast<double>(random() % 1000) / 1000 - 0.5);
            const double house = r % 30 < 12 && c % 40 < 18 ? 6.37 - 0.31 * std::abs(r % 30 - 6) : 0;
            surface.at(r, c) = static_cast<float>(base + 4 * std::sin(r / 17.0) + 0.04 * c + noise + house);
        }
    return surface;
}

template <typename Round>
MetreGrid rounded(MetreGrid surface, double step, const Round& round) {
    for (float& z : surface.values)
        z = static_cast<float>(round(static_cast<double>(z) / step) * step);
    return surface;
}

double step_of(const MetreGrid& surface) {
    Executor threads(2);
    return value_step(surface, threads).value_or(0);
}

TEST(ValueStep, IsWhatElevationsWereRoundedTo) {
    for (const double step : {0.001, 0.01, 0.02, 0.05, 0.1, 0.2, 0.25, 0.3048, 0.5, 0.6096, 1.0, 2.0}) {
        EXPECT_NEAR(step_of(rounded(hills(), step, [](double z) { return std::floor(z); })), step,
                    1e-4 * step);
        EXPECT_NEAR(step_of(rounded(hills(), step, [](double z) { return std::round(z); })), step,
                    1e-4 * step);
    }
}

TEST(ValueStep, IsKnownOfFloatsHighAboveTheSea) {
    for (const double base : {300.0, 1500.0, 2000.0})
        EXPECT_NEAR(step_of(rounded(hills(base), 0.01, [](double z) { return std::round(z); })), 0.01, 1e-5)
            << base;
    EXPECT_NEAR(step_of(rounded(hills(5000), 1, [](double z) { return std::round(z); })), 1, 1e-3);
}

TEST(ValueStep, IsNoneOfWhatWasNotRounded) {
    EXPECT_EQ(step_of(hills()), 0);
    EXPECT_EQ(step_of(MetreGrid(50, 50, 3)), 0);
    EXPECT_EQ(step_of(MetreGrid(50, 50, std::numeric_limits<float>::quiet_NaN())), 0);
    MetreGrid half = rounded(hills(), 1, [](double z) { return std::floor(z); });
    const MetreGrid other = hills();
    std::copy_n(other.values.begin(), other.values.size() / 2, half.values.begin());
    EXPECT_EQ(step_of(half), 0);
}

TEST(ValueStep, IsThatOfMostCellsWhereSomeWereInterpolated) {
    for (const double step : {0.1, 0.5, 1.0}) {
        MetreGrid surface = rounded(hills(), step, [](double z) { return std::floor(z); });
        const MetreGrid exact = hills();
        for (std::size_t cell = 0; cell < surface.values.size(); cell += 67)
            surface.values[cell] = exact.values[cell];
        EXPECT_NEAR(step_of(surface), step, 1e-3 * step);
    }
}

TEST(ValueStep, IsNoneOfBlocksOfWholeHeights) {
    MetreGrid blocks(120, 150);
    for (int r = 0; r < blocks.rows; ++r)
        for (int c = 0; c < blocks.cols; ++c)
            blocks.at(r, c) =
                r % 20 < 12 && c % 25 < 14 ? static_cast<float>(3 + (r / 20 * 7 + c / 25 * 3) % 11) : 0;
    EXPECT_EQ(step_of(blocks), 0);
}

TEST(ValueStep, CountsAddUpInAnyOrder) {
    const MetreGrid surface = rounded(hills(), 0.25, [](double z) { return std::floor(z); });
    StepHistogram whole;
    StepHistogram even;
    StepHistogram odd;
    for (int r = 0; r < surface.rows; ++r) {
        whole.add(surface.row(r));
        (r % 2 == 0 ? even : odd).add(surface.row(r));
    }
    odd.merge(even);
    EXPECT_EQ(odd.pairs, whole.pairs);
    EXPECT_EQ(value_step(odd), value_step(whole));
    EXPECT_TRUE(value_step(whole).has_value());
}

TEST(ValueStep, IsSaidAsItWasMeant) {
    EXPECT_EQ(nearest_round_step(0.0100003), 0.01);
    EXPECT_EQ(nearest_round_step(0.99997), 1);
    EXPECT_EQ(nearest_round_step(0.25001), 0.25);
    EXPECT_EQ(nearest_round_step(2), 2);
    EXPECT_EQ(nearest_round_step(0.015625), 0.015625);
    EXPECT_EQ(nearest_round_step(0.3048), 0.3048);
}

TEST(RoundingNoise, IsThatOfAnEvenDistribution) {
    EXPECT_EQ(rounding_noise(0), 0);
    EXPECT_LT(rounding_noise(0.01), 0.07) << "less than smooth limits have room for anyway";
    double squares = 0;
    constexpr int many = 10000;
    for (int i = 0; i < many; ++i) {
        const double error = (i + 0.5) / many - 0.5;
        squares += error * error;
    }
    EXPECT_NEAR(rounding_noise(1), std::sqrt(squares / many), 1e-6);
}

}  // namespace
}  // namespace d2b::detect

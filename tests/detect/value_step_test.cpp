#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "detect/smoothness.hpp"
#include "detect/surface_quality.hpp"

namespace d2b {
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

TEST(SurfaceQuality, SaysLittleOfSmoothnessWhereRounded) {
    SurfaceQuality quality;
    EXPECT_EQ(quality.uninformative_share(), 0);
    quality.rounded_to = 0.5;
    EXPECT_EQ(quality.uninformative_share(), 0.08);
    quality.filled = 0.2;
    EXPECT_EQ(quality.uninformative_share(), 0.2);
}

}  // namespace
}  // namespace d2b

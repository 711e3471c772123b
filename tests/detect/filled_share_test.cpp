#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "detect/smoothness.hpp"
#include "detect/surface_quality.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

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
                                 Grid<std::uint8_t>(surface.rows, surface.cols), test::threads());
}

TEST(FilledShare, IsThatOfTheCellsThatTookANeighboursHeight) {
    EXPECT_EQ(share_of(crowns(0)), 0.0);
    for (const double filled : {0.05, 0.1, 0.2, 0.35})
        EXPECT_NEAR(share_of(crowns(filled)), filled, 0.25 * filled) << filled;
}

TEST(FilledShare, WhatIsEqualByChanceDoesNotCount) {
    // Of 101 heights that are 10 cm apart one in a hundred pairs is equal.
    EXPECT_EQ(share_of(crowns(0, 0.1)), 0.0);
    EXPECT_NEAR(share_of(crowns(0.2, 0.1)), 0.2, 0.05);
    // Of eleven whole metres one in eleven is: nothing can be said.
    EXPECT_EQ(share_of(crowns(0.05, 1)), 0.0);
}

TEST(FilledShare, LooksAtWhatIsElevatedRoughAndValid) {
    MetreGrid surface = crowns(0.2);
    EXPECT_EQ(share_of(surface, 0), 0.0);
    const Grid<std::uint8_t> smooth(300, 300, smooth_enough);
    EXPECT_EQ(interpolated_fraction(surface, Mask(300, 300, 1), smooth, test::threads()), 0.0);
    const double expected = share_of(surface);
    MetreGrid wider(300, 400, 7.0F);
    Mask elevated(300, 400);
    for (std::int32_t r = 0; r < 300; ++r)
        for (std::int32_t c = 0; c < 300; ++c) {
            wider.at(r, c) = surface.at(r, c);
            elevated.at(r, c) = 1;
        }
    const Grid<std::uint8_t> rough(300, 400);
    EXPECT_EQ(interpolated_fraction(wider, elevated, rough, test::threads()), expected);
    for (std::int32_t r = 0; r < 300; ++r)
        for (std::int32_t c = 300; c < 400; ++c) {
            wider.at(r, c) = std::numeric_limits<float>::quiet_NaN();
            elevated.at(r, c) = 1;
        }
    EXPECT_EQ(interpolated_fraction(wider, elevated, rough, test::threads()), expected);
}

TEST(FilledShare, NeedsThreeHundredPairs) {
    MetreGrid surface(12, 13);  // 12 x 12 + 11 x 13 = 287
    surface.values.assign(surface.size(), 3.0F);
    EXPECT_EQ(share_of(surface), 0.0);
    surface = MetreGrid(13, 13, 3.0F);  // 312
    EXPECT_EQ(share_of(surface), 1.0) << "1.6 times all of them";
    EXPECT_EQ(share_of(MetreGrid()), 0.0);
}

TEST(FilledShare, CountsEachPairOfAMaskOnce) {
    std::mt19937 random(3);  // NOLINT: the same masks in every run
    for (const std::size_t cells : {1U, 2U, 63U, 64U, 65U, 130U}) {
        std::vector<float> here(cells + 1);
        std::vector<float> below(cells + 1);
        std::vector<std::uint8_t> mask(cells + 1);
        std::vector<std::uint8_t> mask_below(cells + 1);
        for (std::size_t c = 0; c <= cells; ++c) {
            here[c] = static_cast<float>(random() % 8);
            below[c] = static_cast<float>(random() % 8);
            mask[c] = random() % 4 == 0 ? 0 : 1;
            mask_below[c] = random() % 2 == 0 ? 0 : 1;
        }
        HeightDifferences expected;
        for (std::size_t c = 0; c < cells; ++c) {
            if (mask[c] == 1 && mask[c + 1] == 1)
                add_difference(std::abs(here[c] - here[c + 1]), expected);
            if (mask[c] == 1 && mask_below[c] == 1)
                add_difference(std::abs(here[c] - below[c]), expected);
        }
        HeightDifferences found;
        add_differences(std::span(here).first(cells), below.data(), mask, mask_below, found);
        EXPECT_EQ(found.all, expected.all) << cells;
        EXPECT_EQ(found.counts, expected.counts) << cells;
    }
}

}  // namespace
}  // namespace d2b

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "ground/quantized_elevations.hpp"
#include "raster/rank_filter.hpp"

namespace d2b::ground {
namespace {

MetreGrid row_of(const std::vector<float>& values) {
    MetreGrid grid(1, static_cast<std::int32_t>(values.size()));
    std::ranges::copy(values, grid.values.begin());
    return grid;
}

/// Value of a file that has so many whole steps.
float written(int steps, int steps_per_metre) {
    return static_cast<float>(static_cast<double>(steps) / steps_per_metre);
}

bool take(QuantizedElevations& steps, const MetreGrid& grid) {
    return steps.take(grid, {0, 0, grid.rows, grid.cols});
}

std::vector<float> back(const QuantizedElevations& steps) {
    std::vector<float> metres(steps.surface.size());
    steps.to_metres(steps.surface.values, metres.data());
    return metres;
}

TEST(QuantizedElevations, AreTheElevationsBitByBit) {
    std::mt19937 random(1);
    for (const int steps_per_metre : {100, 1000})
        for (const int lowest : {-1500, -3, 0, 2, 1400}) {
            std::vector<float> metres{no_value};
            for (int i = 0; i < 20000; ++i)
                metres.push_back(
                    written(lowest * steps_per_metre + static_cast<int>(random() % 60000), steps_per_metre));
            QuantizedElevations steps;
            ASSERT_TRUE(take(steps, row_of(metres))) << steps_per_metre << " " << lowest;
            EXPECT_EQ(steps.steps_per_metre, steps_per_metre);
            const std::vector<float> again = back(steps);
            for (std::size_t i = 0; i < metres.size(); ++i)
                ASSERT_EQ(std::bit_cast<std::uint32_t>(again[i]), std::bit_cast<std::uint32_t>(metres[i]))
                    << metres[i];
            for (std::size_t i = 1; i < metres.size(); ++i)
                ASSERT_EQ(metres[i] < metres[i - 1], steps.surface.values[i] < steps.surface.values[i - 1]);
        }
}

TEST(QuantizedElevations, AreNotTakenOfWhatHasNone) {
    QuantizedElevations steps;
    EXPECT_TRUE(take(steps, row_of({1, 2.5F, 656})));
    EXPECT_FALSE(take(steps, row_of({1, 2.5F, 657}))) << "more than 16 bits of centimetres";
    EXPECT_TRUE(take(steps, row_of({1, 2.503F, 66})));
    EXPECT_FALSE(take(steps, row_of({1, 2.503F, 67}))) << "more than 16 bits of millimetres";
    EXPECT_FALSE(take(steps, row_of({1, 2.5031F, 3})));
    EXPECT_FALSE(take(steps, row_of({1, std::nextafter(2.5F, 3.0F), 3})));
    EXPECT_FALSE(take(steps, row_of({1, -0.0F})));
    EXPECT_FALSE(take(steps, row_of({20000, 20001}))) << "a float has not its centimetres";
    EXPECT_FALSE(take(steps, row_of({no_value, no_value})));
    EXPECT_FALSE(take(steps, row_of({1, std::numeric_limits<float>::infinity()})));
    for (const float far : {3e7F, 1e30F, std::numeric_limits<float>::infinity()}) {
        EXPECT_FALSE(take(steps, row_of({far, 1, 3}))) << "no whole number of 32 bits beside one that is";
        EXPECT_FALSE(take(steps, row_of({-far, 1, 3})));
    }
}

/// Division as floats gives the rounded result of a division as doubles: none of them lies
/// half-way between two floats, or nearly.
TEST(QuantizedElevations, AreDividedAsDoublesAre) {
    constexpr int most = 1638400;
    constexpr int piece = 32000;
    for (const int steps_per_metre : {100, 1000})
        for (int first = -most; first < most; first += piece) {
            std::vector<float> metres;
            for (int n = first; n < std::min(first + piece, most); ++n)
                if (n > -most)
                    metres.push_back(written(n, steps_per_metre));
            QuantizedElevations steps;
            ASSERT_TRUE(take(steps, row_of(metres))) << steps_per_metre << " " << first;
            const std::vector<float> again = back(steps);
            for (std::size_t i = 0; i < metres.size(); ++i)
                ASSERT_EQ(std::bit_cast<std::uint32_t>(again[i]), std::bit_cast<std::uint32_t>(metres[i]))
                    << metres[i];
        }
}

TEST(QuantizedElevations, AreThoseOfAPartOfAGrid) {
    MetreGrid grid(5, 40, 3.14159F);  // no whole step
    for (std::int32_t i = 1; i < 4; ++i)
        for (std::int32_t j = 10; j < 37; ++j)
            grid.at(i, j) = written(100 * i + j, 100);
    QuantizedElevations steps;
    ASSERT_TRUE(steps.take(grid, {1, 10, 3, 27}));
    EXPECT_FALSE(steps.gaps);
    EXPECT_EQ(steps.surface.rows, 3);
    EXPECT_EQ(steps.surface.cols, 27);
    const std::vector<float> again = back(steps);
    for (std::size_t k = 0; k < again.size(); ++k)
        EXPECT_EQ(again[k],
                  grid.at(static_cast<std::int32_t>(1 + k / 27), static_cast<std::int32_t>(10 + k % 27)));
    EXPECT_FALSE(steps.take(grid, {1, 9, 3, 27}));
    grid.at(3, 36) = no_value;
    ASSERT_TRUE(steps.take(grid, {1, 10, 3, 27}));
    EXPECT_TRUE(steps.gaps);
    ASSERT_TRUE(steps.take(grid, {1, 10, 3, 26}));
    EXPECT_FALSE(steps.gaps);
}

TEST(QuantizedElevations, KnowWhatIsSurelyWithinARise) {
    for (const int steps_per_metre : {100, 1000}) {
        QuantizedElevations steps;
        steps.steps_per_metre = steps_per_metre;
        const int lowest = 1600 * steps_per_metre;
        for (const float rise : {0.0F, 0.18F, 0.216F, 0.7F, 1.234F}) {
            const int within = steps.guaranteed_steps(rise);
            EXPECT_GE(within, 0);
            EXPECT_GE(within, rise * static_cast<float>(steps_per_metre) - 3.01F);
            for (int now = lowest; now < lowest + 1000; ++now)
                ASSERT_FALSE(written(now + within, steps_per_metre) > written(now, steps_per_metre) + rise)
                    << now;
        }
    }
}

}  // namespace
}  // namespace d2b::ground

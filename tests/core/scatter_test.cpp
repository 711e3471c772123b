#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/statistics.hpp"

namespace d2b {
namespace {

PointStats stats_of(const std::vector<double>& values, const FixedPoint& fixed) {
    PointStats stats;
    for (const double z : values)
        stats.add(z, fixed);
    return stats;
}

/// Sum of the squared distances from the mean in two passes, which does not lose digits.
double two_pass(const std::vector<double>& values) {
    double sum = 0;
    for (const double z : values)
        sum += z - values[0];
    const double mean = sum / static_cast<double>(values.size());
    double squares = 0;
    for (const double z : values)
        squares += (z - values[0] - mean) * (z - values[0] - mean);
    return squares;
}

TEST(Scatter, OfWholeNumbersIsExact) {
    const FixedPoint fixed(9);
    const PointStats stats = stats_of({2, 4, 4, 4, 5, 5, 7, 9}, fixed);
    EXPECT_EQ(fixed.sum_of_squared_deviations(stats), 32);
    EXPECT_DOUBLE_EQ(fixed.standard_deviation(stats), std::sqrt(32 / 7.0));
}

TEST(Scatter, OfNothingAndOfEqualPointsIsZero) {
    const FixedPoint fixed(8848.86);
    EXPECT_EQ(fixed.sum_of_squared_deviations(PointStats{}), 0);
    EXPECT_EQ(fixed.sum_of_squared_deviations(stats_of({8848.86}, fixed)), 0);
    EXPECT_EQ(fixed.sum_of_squared_deviations(stats_of(std::vector<double>(1000, 8848.86), fixed)), 0);
    EXPECT_EQ(fixed.standard_deviation(stats_of(std::vector<double>(3, -417.3), fixed)), 0);
}

TEST(Scatter, KeepsItsDigitsOnLargeOffsets) {
    std::mt19937 random(7);
    std::normal_distribution<double> heights(0, 3);
    for (const double offset : {0.0, -420.0, 521.5, 8848.0, -1e5, 1e6}) {
        std::vector<double> values;
        double largest = 0;
        for (int i = 0; i < 20000; ++i) {
            values.push_back(offset + heights(random));
            largest = std::max(largest, std::abs(values.back()));
        }
        const FixedPoint fixed(largest);
        const double expected = two_pass(values);
        // Some 30 binary digits of each elevation are kept; what is cut off is no more than that.
        const double cut = std::ldexp(largest, -29);
        EXPECT_NEAR(fixed.sum_of_squared_deviations(stats_of(values, fixed)), expected,
                    20000 * (cut * 3 * 0.1 + cut * cut))
            << offset;
        EXPECT_NEAR(fixed.standard_deviation(stats_of(values, fixed)), std::sqrt(expected / 19999), cut)
            << offset;
    }
}

TEST(Scatter, OfParts) {
    const FixedPoint fixed(500);
    const std::vector<double> values{499.5, 12.25, -300.125, 0.1, 77};
    PointStats merged = stats_of({499.5, 12.25}, fixed);
    merged.merge(stats_of({77, -300.125, 0.1}, fixed));
    EXPECT_EQ(fixed.sum_of_squared_deviations(merged),
              fixed.sum_of_squared_deviations(stats_of(values, fixed)));
    EXPECT_NEAR(fixed.sum_of_squared_deviations(merged), two_pass(values), 1e-3);
}

TEST(Scatter, OfManyPointsDoesNotOverflow) {
    const FixedPoint fixed(1.9999999);
    PointStats stats = stats_of({1.9999999, -1.9999999}, fixed);
    for (int doubling = 0; doubling < 38; ++doubling) {
        const PointStats copy = stats;
        stats.merge(copy);
    }
    EXPECT_EQ(stats.n, std::int64_t{1} << 39);
    EXPECT_NEAR(fixed.standard_deviation(stats), 1.9999999, 1e-8);
}

}  // namespace
}  // namespace d2b

#include "core/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace d2b {
namespace {

Moments moments_of(const std::vector<double>& values) {
    Moments moments;
    for (const double value : values)
        moments.add(value);
    return moments;
}

TEST(ExactSum, IsRoundedOnce) {
    ExactSum sum;
    EXPECT_EQ(sum.value(), 0);
    // Doubles lose the 1 beside 1e16.
    for (const double value : {1e16, 1.0, -1e16, 0.5})
        sum.add(value);
    EXPECT_EQ(sum.value(), 1.5);
    sum.add(-std::ldexp(1, -1074));
    EXPECT_EQ(sum.value(), 1.5);
    sum.add(-1.5);
    EXPECT_EQ(sum.value(), -std::ldexp(1, -1074));
}

TEST(Moments, OfAFewNumbers) {
    // 2 4 4 4 5 5 7 9: mean 5, squared deviations 9 1 1 1 0 0 4 16 = 32, 32 / 7.
    const Moments moments = moments_of({2, 4, 4, 4, 5, 5, 7, 9});
    EXPECT_EQ(moments.mean(), 5);
    EXPECT_EQ(moments.standard_deviation(), std::sqrt(32.0 / 7.0));
}

TEST(Moments, OfNoneAndOne) {
    EXPECT_TRUE(std::isnan(Moments().mean()));
    EXPECT_EQ(Moments().standard_deviation(), 0);
    EXPECT_EQ(moments_of({-3.25}).mean(), -3.25);
    EXPECT_EQ(moments_of({-3.25}).standard_deviation(), 0);
}

TEST(Moments, LoseNothingToCancellation) {
    // 1e16 + 1 - 1e16: doubles alone give 0; the mean of the three is a third.
    EXPECT_EQ(moments_of({1e16, 1, -1e16}).mean(), 1.0 / 3.0);
    // Deviations of 1 on a height of 2^50: naive sums of squares keep none of it.
    const double high = std::ldexp(1, 50);
    EXPECT_EQ(moments_of({high - 1, high, high + 1}).standard_deviation(), 1);
    EXPECT_EQ(moments_of({high - 1, high, high + 1}).mean(), high);
}

TEST(Moments, TakeTheWholeRangeOfDoubles) {
    EXPECT_EQ(moments_of({1e308, 1e308}).mean(), 1e308);
    EXPECT_EQ(moments_of({1e308, 1e308}).standard_deviation(), 0);
    EXPECT_EQ(moments_of({5e-324, 5e-324, 5e-324}).mean(), 5e-324);
    EXPECT_EQ(moments_of({-1e300, 1e300}).standard_deviation(), std::sqrt(2.0) * 1e300);
    EXPECT_EQ(moments_of({-0.0, 0.0}).mean(), 0);
}

TEST(Moments, OfTheLargestDoublesDeviateByANumber) {
    constexpr double most = std::numeric_limits<double>::max();
    // The mean of 2,500 times 0 and 500 times x is x / 6, and the squares of all distances add up to 1250/3
    // x^2.
    for (const double x : {1e100, 1e200, 1e300, 1e306, 1e307, 1e308, most, -most}) {
        std::vector<double> values(3000, 0.0);
        std::fill_n(values.begin(), 500, x);
        EXPECT_DOUBLE_EQ(moments_of(values).standard_deviation(), std::abs(x) * std::sqrt(1250.0 / 3 / 2999));
    }
}

TEST(Moments, DoNotDependOnOrderOrPortions) {
    std::mt19937_64 random(7);
    std::vector<double> values;
    for (int i = 0; i < 5000; ++i)
        values.push_back(
            std::ldexp(static_cast<double>(random() % 2000001) - 1e6, static_cast<int>(random() % 80) - 60));
    const Moments forwards = moments_of(values);
    std::shuffle(values.begin(), values.end(), random);
    Moments merged = moments_of({values.begin(), values.begin() + 1234});
    merged.merge(moments_of({values.begin() + 1234, values.end()}));
    EXPECT_EQ(forwards.n, merged.n);
    EXPECT_EQ(forwards.mean(), merged.mean());
    EXPECT_EQ(forwards.standard_deviation(), merged.standard_deviation());
    EXPECT_EQ(forwards.sum.bins(), merged.sum.bins());
    EXPECT_EQ(forwards.squares.bins(), merged.squares.bins());
}

TEST(Moments, OfManyAreThoseOfEach) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    std::mt19937_64 random(8);
    // Whole units and halves of them, values too large or too small for them, and elevations of a file.
    std::vector<double> values{0x1p-30,          -0x1p-30, 0x1p-31, 0x1p22, -0x1p22, 0x1p22 - 0x1p-30,
                               0x1p22 - 0x1p-31, 1e300,    5e-324,  0,      -0.0,    unknown};
    for (int i = 0; i < 200000; ++i) {
        const auto step = static_cast<double>(random() % 2000001) - 1e6;
        values.push_back(i % 7 == 0   ? unknown
                         : i % 5 == 0 ? std::ldexp(step, static_cast<int>(random() % 80) - 60)
                                      : static_cast<double>(static_cast<float>(step * 0.01)));
    }
    Moments each;
    for (const double value : values)
        if (!std::isnan(value))
            each.add(value);
    Moments all;
    all.add_valid(values);
    all.add_valid({});
    EXPECT_EQ(all.n, each.n);
    EXPECT_EQ(all.sum.value(), each.sum.value());
    EXPECT_EQ(all.squares.value(), each.squares.value());
    EXPECT_EQ(all.mean(), each.mean());
    EXPECT_EQ(all.standard_deviation(), each.standard_deviation());
    // Leaves out the largest, beside which the others count for little.
    Moments rest;
    rest.add_valid(std::span<const double>(values).subspan(12));
    Moments each_of_rest;
    for (const double value : std::span<const double>(values).subspan(12))
        if (!std::isnan(value))
            each_of_rest.add(value);
    EXPECT_EQ(rest.mean(), each_of_rest.mean());
    EXPECT_EQ(rest.standard_deviation(), each_of_rest.standard_deviation());
}

TEST(Moments, AgreeWithTwoPassesInLongDouble) {
    std::mt19937 random(3);
    std::vector<double> values;
    for (int i = 0; i < 1000; ++i)
        values.push_back(static_cast<double>(static_cast<float>(random() % 100000) * 0.01F));
    long double sum = 0;
    for (const double value : values)
        sum += static_cast<long double>(value);
    const long double mean = sum / 1000;
    long double squares = 0;
    for (const double value : values) {
        const long double off = static_cast<long double>(value) - mean;
        squares += off * off;
    }
    EXPECT_DOUBLE_EQ(moments_of(values).mean(), static_cast<double>(mean));
    EXPECT_DOUBLE_EQ(moments_of(values).standard_deviation(), static_cast<double>(std::sqrt(squares / 999)));
}

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
        // Some 30 binary digits of each elevation are kept; the part cut off is no more than that.
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

TEST(FixedPoint, MeansAreExactForWhatFits) {
    for (const double largest : {0.001, 1.0, 25.0, 9000.0, 1e30}) {
        const FixedPoint fixed(largest);
        PointStats stats;
        for (const double share : {1.0, -0.5, 0.25, 0.125})
            stats.add(share * largest, fixed);
        EXPECT_EQ(fixed.mean(stats.sum, stats.n), largest * 0.875 / 4) << largest;
        EXPECT_EQ(stats.lowest, -0.5 * largest);
        EXPECT_EQ(stats.highest, largest);
    }
}

TEST(ElevationSample, PercentilesAreNearestRanks) {
    const ElevationRange range{15, 50};
    ElevationSample sample;
    for (const double z : {50.0, 15.0, 35.0, 40.0, 20.0})
        sample.add(z, range);
    // The classic example of the nearest rank: 30 % of five is the 2nd, 40 % the 2nd, 50 % the 3rd, 100 % the
    // 5th.
    EXPECT_EQ(sample.percentiles({0.05, 0.30, 0.40, 0.50, 1.00}, range),
              (std::vector<double>{15, 20, 20, 35, 50}));
    EXPECT_EQ(sample.size(), 5);
}

TEST(ElevationSample, TheSamePointsGiveTheSameWhateverTheOrderOfMerges) {
    const ElevationRange range{-10, 120};
    std::mt19937 random(11);
    for (const std::size_t points : {1000U, 131072U, 131073U, 400000U}) {
        std::vector<double> values;
        ElevationSample whole;
        ElevationSample merged;
        ElevationSample piece;
        for (std::size_t i = 0; i < points; ++i) {
            values.push_back(-10 + static_cast<double>(random() % 130001) / 1000);
            whole.add(values.back(), range);
            piece.add(values.back(), range);
            if (i % 150000 == 149999) {
                merged.merge(piece, range);
                EXPECT_EQ(piece.size(), 0);
            }
        }
        piece.merge(merged, range);
        std::sort(values.begin(), values.end());
        const std::vector<double> shares{0.0, 0.1, 0.5, 0.9, 1.0};
        EXPECT_EQ(whole.percentiles(shares, range), piece.percentiles(shares, range));
        for (std::size_t i = 0; i < shares.size(); ++i) {
            const double rank = std::max(1.0, std::ceil(shares[i] * static_cast<double>(points)));
            const double expected = values[static_cast<std::size_t>(rank) - 1];
            EXPECT_NEAR(whole.percentiles(shares, range)[i], expected, points > 131072 ? 130.0 / 65536 : 0.0);
        }
    }
}

TEST(ElevationRange, BinsStayInRange) {
    const ElevationRange range{-1.7e308, 1.7e308};
    EXPECT_EQ(range.bin(-1.7e308), 0U);
    EXPECT_EQ(range.bin(1.7e308), 65535U);
    EXPECT_NEAR(range.elevation(32768) / 1.7e308, 0, 1e-4);
    EXPECT_EQ((ElevationRange{5, 5}).bin(5), 0U);
    EXPECT_EQ((ElevationRange{5, 5}).elevation(0), 5);
    const ElevationRange city{0, 100};
    for (const double z : {0.0, 12.345, 99.999, 100.0})
        EXPECT_NEAR(city.elevation(city.bin(z)), z, 100.0 / 65536);
}

}  // namespace
}  // namespace d2b

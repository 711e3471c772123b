#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "core/statistics.hpp"

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
    // Whole units and halves of them, what is too large for them or too small, and elevations of a file.
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
    // Without the largest, beside which the others count for little.
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

}  // namespace
}  // namespace d2b

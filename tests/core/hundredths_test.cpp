#include <limits>

#include <gtest/gtest.h>

#include "core/text.hpp"

namespace d2b {
namespace {

TEST(Hundredths, AreTheNumbersOfTwoDigits) {
    EXPECT_EQ(round_to_hundredths(36.98765), 36.99);
    EXPECT_EQ(round_to_hundredths(9.994999), 9.99);
    EXPECT_EQ(round_to_hundredths(-0.126), -0.13);
    EXPECT_EQ(round_to_hundredths(123456789.123), 123456789.12);
    EXPECT_TRUE(std::isnan(round_to_hundredths(std::numeric_limits<double>::quiet_NaN())));
}

/// What a bound of two digits leaves out looks left out when it is written.
TEST(Hundredths, OfAShareAreNotRoundedUp) {
    EXPECT_EQ(floor_to_hundredths(0.4999), 0.49);
    EXPECT_EQ(floor_to_hundredths(0.8999999), 0.89);
    for (int i = 0; i <= 100; ++i)
        EXPECT_EQ(floor_to_hundredths(i / 100.0), i / 100.0);
    EXPECT_TRUE(std::isnan(floor_to_hundredths(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace d2b

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "elevations/statistics.hpp"

namespace d2b {
namespace {

TEST(ValueRange, AreThoseOfAllThatAreKnown) {
    std::mt19937 random(3);
    for (std::size_t size = 0; size < 200; ++size) {
        std::vector<double> values;
        ValueRange expected;
        for (std::size_t i = 0; i < size; ++i) {
            const bool known = random() % 5 != 0;
            const double z = static_cast<double>(random() % 1000) / 7 - 50;
            values.push_back(known ? z : std::numeric_limits<double>::quiet_NaN());
            if (!known)
                continue;
            expected.lowest = std::fmin(expected.lowest, z);
            expected.highest = std::fmax(expected.highest, z);
            ++expected.known;
        }
        const ValueRange found = value_range(values);
        EXPECT_EQ(found.lowest, expected.lowest) << size;
        EXPECT_EQ(found.highest, expected.highest) << size;
        EXPECT_EQ(found.known, expected.known) << size;
    }
}

TEST(ValueRange, AreNoneWhereNothingIsKnown) {
    const std::vector<double> values(9, std::numeric_limits<double>::quiet_NaN());
    const ValueRange found = value_range(values);
    EXPECT_GT(found.lowest, found.highest);
}

}  // namespace
}  // namespace d2b

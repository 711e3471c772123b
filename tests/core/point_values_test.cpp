#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/statistics.hpp"

namespace d2b {
namespace {

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

TEST(FixedPoint, ManyLargeValuesDoNotOverflow) {
    const FixedPoint fixed(1.9999999);
    PointStats stats;
    for (int doubling = 0; doubling < 40; ++doubling) {
        PointStats copy = stats;
        stats.merge(copy);
        stats.add(1.9999999, fixed);
    }
    EXPECT_GT(stats.n, std::int64_t{1} << 39);
    EXPECT_DOUBLE_EQ(fixed.mean(stats.sum, stats.n), 1.9999999);
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

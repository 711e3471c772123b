#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "core/elevation_sample.hpp"
#include "core/point_stats.hpp"

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
    const ElevationRange range{0, 65536};  // a bin is one unit wide
    ElevationSample sample;
    for (const int z : {15, 20, 35, 40, 50})
        sample.add(range.bin(z));
    // The classic example of the nearest rank: 30 % of five is the 2nd, 40 % the 2nd, 50 % the 3rd, 100 % the
    // 5th.
    EXPECT_EQ(sample.percentile(0.05, range), 15.5);
    EXPECT_EQ(sample.percentile(0.30, range), 20.5);
    EXPECT_EQ(sample.percentile(0.40, range), 20.5);
    EXPECT_EQ(sample.percentile(0.50, range), 35.5);
    EXPECT_EQ(sample.percentile(1.00, range), 50.5);
}

TEST(ElevationSample, ListAndHistogramAgreeWhateverTheOrderOfMerges) {
    const ElevationRange range{-10, 120};
    std::mt19937 random(11);
    std::vector<std::uint16_t> values;
    ElevationSample whole;
    ElevationSample merged;
    for (int part = 0; part < 3; ++part) {
        ElevationSample piece;
        for (int i = 0; i < 150000; ++i) {
            values.push_back(static_cast<std::uint16_t>(random()));
            whole.add(values.back());
            piece.add(values.back());
        }
        merged.merge(piece);
        EXPECT_EQ(piece.size(), 0);
    }
    std::sort(values.begin(), values.end());
    for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
        const auto rank = std::max<std::size_t>(1, static_cast<std::size_t>(share * 450000));
        EXPECT_EQ(whole.percentile(share, range), range.elevation(values[rank - 1]));
        EXPECT_EQ(merged.percentile(share, range), range.elevation(values[rank - 1]));
    }
}

TEST(ElevationRange, BinsStayInRange) {
    const ElevationRange range{-1.7e308, 1.7e308};
    EXPECT_EQ(range.bin(-1.7e308), 0);
    EXPECT_EQ(range.bin(1.7e308), 65535);
    EXPECT_NEAR(range.elevation(32768) / 1.7e308, 0, 1e-4);
    EXPECT_EQ((ElevationRange{5, 5}).bin(5), 0);
    EXPECT_EQ((ElevationRange{5, 5}).elevation(0), 5);
    const ElevationRange city{0, 100};
    for (const double z : {0.0, 12.345, 99.999, 100.0})
        EXPECT_NEAR(city.elevation(city.bin(z)), z, 100.0 / 65536);
}

}  // namespace
}  // namespace d2b

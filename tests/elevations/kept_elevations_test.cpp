#include <cmath>

#include <gtest/gtest.h>

#include "elevations/elevation_cache.hpp"

namespace d2b {
namespace {

const Window window{10, 5, 4, 3};
const BandShape upper{10, 2, 3};
const BandShape lower{12, 2, 3};
const std::vector<double> floats{1, 2.5, 3, 4, 5, 6};
const std::vector<double> wide{0.1, 7, 8, 9, 10, 11};  // 0.1 is no float

/// Both bands, the upper one of floats.
void keep_both(ElevationCache& kept) {
    Executor threads;
    ASSERT_TRUE(kept.wanted());
    kept.begin(2, threads);
    kept.put(0, upper, kept.keep({upper, floats}));
    kept.put(1, lower, kept.keep({lower, wide}));
    kept.end();
}

std::vector<double> read(const ElevationCache& kept, std::size_t band, const Window& part) {
    std::vector<double> cells{-1};  // stays
    kept.append(band, band == 0 ? upper : lower, part, cells);
    return cells;
}

TEST(ElevationCache, GivesPartsOfBandsToTheLastBit) {
    ElevationCache kept(window, 100);
    EXPECT_FALSE(kept.complete());
    keep_both(kept);
    EXPECT_TRUE(kept.complete());
    EXPECT_FALSE(kept.wanted());
    EXPECT_EQ(read(kept, 0, {0, 0, 2, 3}), (std::vector<double>{-1, 1, 2.5, 3, 4, 5, 6}));
    EXPECT_EQ(read(kept, 0, {0, 1, 2, 2}), (std::vector<double>{-1, 2.5, 3, 5, 6}));
    EXPECT_EQ(read(kept, 1, {0, 0, 2, 1}), (std::vector<double>{-1, 0.1, 9}));
    EXPECT_EQ(read(kept, 1, {1, 0, 1, 3}), (std::vector<double>{-1, 9, 10, 11}));
}

TEST(ElevationCache, KeepsNothingWhereMemoryIsShort) {
    ElevationCache too_large(window, 12 * sizeof(float) - 1);
    EXPECT_FALSE(too_large.wanted());
    // The cells would fit as floats, but one of them is wide.
    ElevationCache wider(window, 12 * sizeof(float));
    keep_both(wider);
    EXPECT_FALSE(wider.complete());
    EXPECT_FALSE(wider.wanted());
    ElevationCache enough(window, 6 * sizeof(float) + 6 * sizeof(double));
    keep_both(enough);
    EXPECT_TRUE(enough.complete());
}

TEST(ElevationCache, LendsFloatsAlone) {
    ElevationCache mixed(window, 100);
    keep_both(mixed);
    EXPECT_EQ(mixed.lend().rows, 0);
    ElevationCache kept({10, 5, 2, 3}, 100);
    Executor threads;
    kept.begin(1, threads);
    kept.put(0, upper, kept.keep({upper, floats}));
    EXPECT_EQ(kept.lend().rows, 0);  // the pass is not over
    kept.end();
    kept.set_invalid(0, upper, std::vector<std::size_t>{4});
    MetreGrid lent = kept.lend();
    ASSERT_EQ(lent.rows, 2);
    EXPECT_EQ(lent.row(0)[1], 2.5F);
    EXPECT_TRUE(std::isnan(lent.row(1)[1]));
    kept.take_back(std::move(lent));
    EXPECT_EQ(read(kept, 0, {0, 2, 2, 1}), (std::vector<double>{-1, 3, 6}));
}

}  // namespace
}  // namespace d2b

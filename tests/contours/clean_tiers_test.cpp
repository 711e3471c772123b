#include "contours/clean_tiers.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace d2b {
namespace {

TEST(RegionOptions, ABorderCostsWhatAStripStandsOut) {
    // A strip 100 m long that stands out by 2 m, in points that are so far off, for each cell of its border.
    for (const double side : {0.25, 0.5, 1.0, 2.5, 5.0}) {
        const double wide = std::max(1.0, side);
        const double error = 100 * wide / (side * side) * 2 * 2;
        EXPECT_NEAR(region_options(2, {side, side}, 1).price, error / (100 / side), 1e-9) << side;
    }
    // Cells need not be square, nor heights be in metres.
    EXPECT_NEAR(region_options(2, {0.25, 1}, 1).price, 8, 1e-9);
    EXPECT_NEAR(region_options(2, {2.5, 2.5}, 0.3048).price, 4 / (0.3048 * 0.3048), 1e-9);
}

}  // namespace
}  // namespace d2b

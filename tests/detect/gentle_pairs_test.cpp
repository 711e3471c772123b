#include <gtest/gtest.h>

#include "detect/object_features.hpp"
#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

double share_of(const test::Town& town, const Mask& objects) {
    LowSlopePairs pairs;
    const Regions regions = connected_regions(objects, 1, 0, test::threads());
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r))
            pairs.add(town.scene(), objects, r, run);
    return pairs.share();
}

TEST(LowSlopePairs, SlopesOfNeighboursWithin) {
    // Six cells have seven pairs: three to the right of which one rises by 2 m, two of four further down.
    test::Town town(4, 4, {2, 4});
    town.block(1, 1, 3, 4, 105);
    town.surface.at(1, 3) = 107;
    town.surface.at(2, 1) = 107;
    const Mask objects = test::drawn({"....", ".###", ".###", "...."});
    // Across 2 m is too much for cells of 2 m, down it is not for cells of 4 m.
    EXPECT_NEAR(share_of(town, objects), 5 / 7.0, 1e-12);
    // At the very slope, and just below.
    town.build([](std::int32_t, std::int32_t c) { return 100 + 1.125F * static_cast<float>(c); });
    EXPECT_NEAR(share_of(town, objects), 3 / 7.0, 1e-12);
    town.build([](std::int32_t, std::int32_t c) { return 100 + 1.0625F * static_cast<float>(c); });
    EXPECT_EQ(share_of(town, objects), 1);
}

TEST(LowSlopePairs, WhatIsNotKnownIsNearToNothing) {
    test::Town town(1, 3);
    town.surface.at(0, 1) = test::unknown;
    EXPECT_EQ(share_of(town, Mask(1, 3, 1)), 0);
    EXPECT_EQ(share_of(town, test::drawn({"#.#"})), 1) << "no pairs";
}

TEST(LowSlopePairs, AtTheRastersBorder) {
    test::Town town(2, 2);
    town.surface.at(1, 1) = 150;
    EXPECT_EQ(share_of(town, Mask(2, 2, 1)), 0.5);
}

}  // namespace
}  // namespace d2b

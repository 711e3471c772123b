#include "surface/level_roofs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "surface/label_contours.hpp"

namespace d2b::surface {
namespace {

std::vector<std::int64_t> tops(const SurfaceCluster& cluster) {
    std::vector<std::int64_t> tops;
    for (const PartitionContour& contour : cluster.contours)
        tops.push_back(contour.top);
    return tops;
}

/// One cell of 10.1 m beside three of 10 m: together they are 10.025 m high, and keep their volume.
TEST(LevelRoofs, becomeOneAtTheirMean) {
    SurfaceCluster cluster = blocks_of({{"abbb"}}, {10100, 10000});
    const auto steps = level_roofs(cluster, 200);
    EXPECT_EQ(tops(cluster), (std::vector<std::int64_t>{10025, 10025}));
    ASSERT_EQ(steps.size(), 1U);
    EXPECT_EQ(steps[0].before, 100);
    EXPECT_EQ(steps[0].after, 0);
    EXPECT_EQ(steps[0].contours, (std::array<std::int32_t, 2>{0, 1}));
    EXPECT_EQ(steps[0].place.col, 1024);
}

/// Half a metre of houses 3 m high would be more than a hundredth of their volume.
TEST(LevelRoofs, stayWhereTooMuchWouldMove) {
    SurfaceCluster cluster = blocks_of({{"aabb"}}, {3000, 3500});
    const auto steps = level_roofs(cluster, 1000);
    EXPECT_EQ(tops(cluster), (std::vector<std::int64_t>{3000, 3500}));
    ASSERT_EQ(steps.size(), 1U);
    EXPECT_EQ(steps[0].before, 500);
    EXPECT_EQ(steps[0].after, 500);
}

/// The hundredth is one of all that touches: of two steps the lower one goes.
TEST(LevelRoofs, theLowestStepGoesFirst) {
    SurfaceCluster cluster = blocks_of({{"aabbcc"}}, {3000, 3060, 3260});
    const auto steps = level_roofs(cluster, 1000);
    EXPECT_EQ(tops(cluster), (std::vector<std::int64_t>{3030, 3030, 3260}));
    ASSERT_EQ(steps.size(), 2U);
    EXPECT_EQ(steps[0].after, 0);
    EXPECT_EQ(steps[1].before, 200);
    EXPECT_EQ(steps[1].after, 230);
}

TEST(LevelRoofs, whatIsAsHighAsAskedOrDoesNotTouchStays) {
    SurfaceCluster cluster = blocks_of({{"ab c"}}, {10000, 10200, 10300});
    EXPECT_TRUE(level_roofs(cluster, 200).empty());
    EXPECT_TRUE(level_roofs(cluster, 0).empty());
    EXPECT_EQ(tops(cluster), (std::vector<std::int64_t>{10000, 10200, 10300}));
}

/// A tier of one cell that is 0.1 m higher than the eight around it.
TEST(LevelRoofs, tiersOfAStack) {
    SurfaceCluster cluster = stacks_of({{"111", "121", "111"}});
    ASSERT_EQ(cluster.contours.size(), 2U);
    cluster.contours[0].top = 9000;
    cluster.contours[1].top = 9090;
    const auto steps = level_roofs(cluster, 500);
    EXPECT_EQ(tops(cluster), (std::vector<std::int64_t>{9010, 9010}));
    EXPECT_EQ(steps.size(), 1U);
}

/// Whatever the town: steps lower than asked are named, blocks keep their volumes, and no roof moves by
/// more than its share.
TEST(LevelRoofs, randomTowns) {
    std::mt19937 random(25);
    for (int i = 0; i < 100; ++i) {
        LetterGrid grid;
        for (int row = 0; row < 6; ++row) {
            std::string& line = grid.rows.emplace_back();
            for (int col = 0; col < 6; ++col)
                line += "abcde "[random() % 6];
        }
        SurfaceCluster cluster = blocks_of(grid, {9000, 9100, 9250, 9900, 11000});
        const std::vector<std::int64_t> before = tops(cluster);
        const auto steps = level_roofs(cluster, 500);
        double held = 0;
        double holds = 0;
        double moved = 0;
        for (std::size_t c = 0; c < before.size(); ++c) {
            // Each letter's cells; a block of letters has no holes but those that others fill.
            double twice = 0;
            const auto add = [&](const FineRing& ring) {
                for (std::size_t k = 0; k < ring.size(); ++k) {
                    const FinePoint& a = ring[k];
                    const FinePoint& b = ring[(k + 1) % ring.size()];
                    twice += static_cast<double>(b.row - a.row) * static_cast<double>(a.col + b.col);
                }
            };
            add(cluster.contours[c].outline.exterior);
            for (const FineRing& ring : cluster.contours[c].outline.interiors)
                add(ring);
            const double area = std::abs(twice) / 2;
            held += area * static_cast<double>(before[c]);
            holds += area * static_cast<double>(cluster.contours[c].top);
            moved += area * static_cast<double>(std::abs(cluster.contours[c].top - before[c]));
        }
        EXPECT_NEAR(holds, held, held * 1e-4);
        EXPECT_LE(moved, held * 0.0102);
        SurfaceCluster again = cluster;
        for (const RoofStep& step : level_roofs(again, 500))
            EXPECT_TRUE(std::ranges::any_of(steps, [&](const RoofStep& known) {
                return known.contours == step.contours && known.after > 0;
            })) << i;
    }
}

}  // namespace
}  // namespace d2b::surface

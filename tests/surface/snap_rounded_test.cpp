#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "surface/partition.hpp"
#include "surface/vertex_snapping.hpp"

namespace d2b {
namespace {

bool is_sound(const std::vector<PartitionContour>& contours) {
    return make_partition(contours).conflicting.empty();
}

/// Rows run to the south: down, to the east, and back.
PartitionContour house(FineRing ring, std::int32_t building, std::int64_t top = 10) {
    return {{std::move(ring), {}}, -1, building, top};
}

/// The corner of a house has come to lie a step within the wall of another.
TEST(SnapRounded, aCornerBehindAWall) {
    std::vector<PartitionContour> contours{house({{0, 0}, {1000, 2}, {1000, 1000}, {0, 1000}}, 0),
                                           house({{300, -500}, {700, -500}, {500, 2}}, 1)};
    ASSERT_FALSE(is_sound(contours));
    snap_round(contours);
    EXPECT_TRUE(is_sound(contours));
    EXPECT_EQ(contours[0].outline.exterior, (FineRing{{0, 0}, {500, 2}, {1000, 2}, {1000, 1000}, {0, 1000}}));
    EXPECT_EQ(contours[1].outline.exterior, (FineRing{{300, -500}, {700, -500}, {500, 2}}));
}

/// What is not at odds is not changed, however near its corners lie.
TEST(SnapRounded, whatIsSoundStays) {
    std::vector<PartitionContour> contours{house({{0, 0}, {1000, 2}, {1000, 1000}, {0, 1000}}, 0),
                                           house({{300, -500}, {700, -500}, {500, 0}}, 1)};
    ASSERT_TRUE(is_sound(contours));
    const FineRing before = contours[0].outline.exterior;
    snap_round(contours);
    EXPECT_EQ(contours[0].outline.exterior, before);
}

/// A needle whose tip has come to lie beyond its other wall: what is left of it is not passed there and back.
TEST(SnapRounded, aNeedleThatTurnedOver) {
    std::vector<PartitionContour> contours{house(
        {{0, 0}, {1000, 0}, {1000, 1000}, {501, 1000}, {500, 1900}, {501, 1950}, {500, 1000}, {0, 1000}}, 0)};
    ASSERT_FALSE(is_sound(contours));
    snap_round(contours);
    EXPECT_TRUE(is_sound(contours));
    const FineRing& ring = contours[0].outline.exterior;
    for (std::size_t i = 0; i < ring.size(); ++i)
        EXPECT_NE(ring[i], ring[(i + 2) % ring.size()]);
}

/// What is no wider than a step is not taken for a house of no area: it stays at odds, and is found to be.
TEST(SnapRounded, aHouseThatIsGoneIsFound) {
    std::vector<PartitionContour> contours{house({{0, 0}, {1, 500}, {0, 1000}, {0, 400}}, 0)};
    snap_round(contours);
    EXPECT_GT(contours[0].outline.exterior.size(), 2U);
}

/// A place off the beginning of a wall that runs at an angle: along it, and to its left. Rounded.
FinePoint rounded(double angle, double along, double left) {
    return {-std::llround(along * std::sin(angle) + left * std::cos(angle)),
            std::llround(along * std::cos(angle) - left * std::sin(angle))};
}

/// A house whose long wall runs past the tips of others, which are less than a step off, and past those of
/// its own towers. All are counter-clockwise and apart before they are rounded.
std::vector<PartitionContour> tips_beside_a_wall(std::mt19937& random) {
    const double angle = 0.001 * static_cast<double>(random() % 6283);
    const auto at = [&](double along, double left) { return rounded(angle, along, left); };
    std::vector<PartitionContour> contours{house({at(0, 0), at(2000, 0), at(2000, 500), at(0, 500)}, 0)};
    for (std::int32_t i = 1; i < 10; ++i) {
        const double off = 0.01 * static_cast<double>(1 + random() % 99);
        const double along = 200 * i + 0.1 * static_cast<double>(random() % 100);
        if (i % 3 == 0) {
            contours.push_back(house({at(along, off), at(along + 70, 200), at(along - 70, 200)}, 0, 20));
            contours.back().parent = 0;
        } else {
            contours.push_back(house({at(along, -off), at(along - 70, -200), at(along + 70, -200)}, i));
        }
    }
    return contours;
}

/// Whichever way they are rounded, all of it can be built, and no corner has moved.
TEST(SnapRounded, randomTips) {
    std::mt19937 random(7);
    int conflicting = 0;
    for (int run = 0; run < 300; ++run) {
        std::vector<PartitionContour> contours = tips_beside_a_wall(random);
        const std::vector<PartitionContour> before = contours;
        conflicting += is_sound(contours) ? 0 : 1;
        snap_round(contours);
        ASSERT_TRUE(is_sound(contours)) << run;
        for (std::size_t i = 0; i < contours.size(); ++i)
            for (const FinePoint& corner : before[i].outline.exterior)
                ASSERT_EQ(std::ranges::count(contours[i].outline.exterior, corner), 1) << run;
    }
    EXPECT_GT(conflicting, 100);
}

}  // namespace
}  // namespace d2b

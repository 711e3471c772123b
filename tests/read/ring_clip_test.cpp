#include <gtest/gtest.h>

#include "read/ring_projection.hpp"

namespace d2b {
namespace {

constexpr ClipBox box{0, 0, 10, 10};

TEST(RingClip, whatLiesWithinIsLeftAsItIs) {
    const WorldRing ring{{1, 1}, {9, 1}, {9, 10}, {1, 1}};
    EXPECT_EQ(clipped(ring, box), ring);
    EXPECT_EQ(clipped(ring, ClipBox{}), ring);
    EXPECT_EQ(clipped({}, box), WorldRing{});
}

TEST(RingClip, whatReachesOutIsCutOff) {
    EXPECT_EQ(clipped({{5, 5}, {15, 5}, {15, 8}, {5, 8}, {5, 5}}, box),
              (WorldRing{{5, 5}, {10, 5}, {10, 8}, {5, 8}, {5, 5}}));
    // Open rings are closed.
    EXPECT_EQ(clipped({{-20, -20}, {30, -20}, {30, 30}, {-20, 30}}, box),
              (WorldRing{{10, 0}, {10, 10}, {0, 10}, {0, 0}, {10, 0}}));
}

TEST(RingClip, whatLiesElsewhereGoes) {
    EXPECT_TRUE(clipped({{15, 5}, {25, 5}, {25, 8}, {15, 5}}, box).empty());
}

TEST(RingClip, farAwayIsFarAway) {
    const WorldRing part = clipped({{5, 5}, {1e200, 5}, {1e200, 8}, {5, 8}, {5, 5}}, box);
    EXPECT_EQ(part, (WorldRing{{5, 5}, {10, 5}, {10, 8}, {5, 8}, {5, 5}}));
}

}  // namespace
}  // namespace d2b

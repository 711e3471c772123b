#include "surface/roof_heights.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace d2b::surface {
namespace {

using Heights = std::vector<std::int64_t>;

PartitionContour level(std::int64_t top) {
    return {{}, -1, 0, top, {}};
}

/// A plane of this height at the origin, and the cosine of its slope.
PartitionContour slanted(double height, double cosine = 1) {
    return {{}, -1, 0, 0, RoofPlane{{0, 0}, height, 0.5, 0.25, cosine, 1, 1}};
}

Heights at_origin(const std::vector<PartitionContour>& contours) {
    std::vector<std::int32_t> around;
    for (std::size_t i = 0; i < contours.size(); ++i)
        around.push_back(static_cast<std::int32_t>(i));
    return heights_at({0, 0}, around, contours);
}

TEST(RoofHeights, levelRoofsKeepTheirs) {
    EXPECT_EQ(at_origin({level(10), level(11), level(10)}), (Heights{10, 11, 10}));
}

TEST(RoofHeights, ofPlanesAwayFromTheirPoint) {
    const std::vector<PartitionContour> contours{slanted(100)};
    const std::vector<std::int32_t> around{0, open_ground};
    EXPECT_EQ(heights_at({8, -4}, around, contours), (Heights{103, no_height}));
}

TEST(RoofHeights, planesThatMeetGetTheirMean) {
    EXPECT_EQ(at_origin({slanted(10), slanted(11)}), (Heights{11, 11}));  // 10.5 is rounded up
    EXPECT_EQ(at_origin({slanted(10.4), slanted(11.5)}), (Heights{11, 11}));
    // A steep plane yields more, because its distance from the point is less than the difference in height.
    EXPECT_EQ(at_origin({slanted(10.2, 1), slanted(11.2, 0.25)}), (Heights{10, 10}));
}

TEST(RoofHeights, aLevelRoofStaysLevelWhereAPlaneMeetsIt) {
    EXPECT_EQ(at_origin({level(10), slanted(10.9)}), (Heights{10, 10}));
}

TEST(RoofHeights, othersAreTwoStepsApart) {
    EXPECT_EQ(at_origin({slanted(10), slanted(11.3), slanted(20)}), (Heights{10, 12, 20}));
}

/// Level, with steps of half a millimetre.
RoofPlane level_plane() {
    return {{0, 0}, 0, 0, 0, 1, 0.5, 0.5};
}

TEST(AngleBetween, isThatOfTheSlopeOverALevelPlane) {
    // A rise of 500 steps over 1000 columns of half a step.
    const std::array<RoofCorner, 3> eastwards{{{0, 0, 0}, {0, 1000, 500}, {-700, 0, 0}}};
    EXPECT_NEAR(angle_between(level_plane(), eastwards), 45, 1e-9);
    const std::array<RoofCorner, 3> northwards{{{0, 0, 0}, {0, 10, 0}, {-2000, 0, 1000 * std::sqrt(3)}}};
    EXPECT_NEAR(angle_between(level_plane(), northwards), 60, 1e-9);
    const std::array<RoofCorner, 3> other_way{{{0, 0, 0}, {-700, 0, 0}, {0, 1000, 500}}};
    EXPECT_NEAR(angle_between(level_plane(), other_way), 45, 1e-9) << "the same in either orientation";
}

TEST(AngleBetween, isNothingInThePlane) {
    const RoofPlane plane{{0, 0}, 0, -0.5, 0.25, 1, 0.5, 0.5};
    EXPECT_NEAR(angle_between(plane, {{{0, 0, 0}, {0, 1000, 250}, {-1000, 0, 500}}}), 0, 1e-6);
}

/// True if a triangle with a fourth corner on its first side is twisted.
bool is_twisted(const std::array<RoofCorner, 4>& corners) {
    const PartitionFace face{{0, 1, 2, 3}, {}};
    const std::array<PartitionTriangle, 2> triangles{{{0, 1, 3}, {1, 2, 3}}};
    return is_twisted(level_plane(), face, triangles, [&](std::uint32_t node) { return corners.at(node); });
}

TEST(TwistedRoofs, haveATriangleThatTurnsAway) {
    EXPECT_FALSE(is_twisted({{{0, 0, 0}, {9, 5000, 0}, {0, 10000, 0}, {-9000, 5000, 0}}}));
    // Half a millimetre of height, far off the line between its neighbours.
    EXPECT_FALSE(is_twisted({{{0, 0, 0}, {9000, 5000, 0.5}, {0, 10000, 0}, {-9000, 5000, 0}}}));
    EXPECT_TRUE(is_twisted({{{0, 0, 0}, {0, 3, 1}, {0, 10000, 0}, {-9000, 5000, 0}}}));
}

TEST(TwistedRoofs, bendBetweenNearCorners) {
    // On a line in plan, where no triangle turns away: 14 and 12 steps as they were in a roof of Seville.
    EXPECT_TRUE(is_twisted({{{0, 0, 0}, {0, 14, 0.5}, {0, 26, 0}, {-9000, 13, 0}}}));
    EXPECT_FALSE(is_twisted({{{0, 0, 0}, {0, 14, 0}, {0, 26, 0}, {-9000, 13, 0}}})) << "on a line in space";
    EXPECT_FALSE(is_twisted({{{0, 0, 0}, {0, 1400, 0.5}, {0, 2600, 0}, {-9000, 13, 0}}})) << "far apart";
}

}  // namespace
}  // namespace d2b::surface

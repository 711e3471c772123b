#include "surface/roof_heights.hpp"

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
    return {{}, -1, 0, 0, RoofPlane{{0, 0}, height, 0.5, 0.25, cosine}};
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

}  // namespace
}  // namespace d2b::surface

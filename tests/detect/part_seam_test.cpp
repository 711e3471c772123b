#include <cmath>

#include <gtest/gtest.h>

#include "detect/tree_crowns.hpp"

namespace d2b {
namespace {

constexpr CellSize half_metre{0.5, 0.5};

/// The seam of a part that lies below row 20 and to the right of column 30 of a roof with its corner there.
SharedBoundary around_a_corner(std::int32_t below, std::int32_t beside) {
    SharedBoundary seam;
    for (std::int32_t c = 30 - below; c < 30; ++c)
        seam.add(20, c, -1, 0, half_metre);
    for (std::int32_t r = 20 - beside; r < 20; ++r)
        seam.add(r, 30, 0, -1, half_metre);
    return seam;
}

bool is_near(const MetricPoint& one, const MetricPoint& other) {
    return std::hypot(one.x - other.x, one.y - other.y) < 1e-9;
}

TEST(SharedBoundary, HasTwoLinesAroundACorner) {
    const SharedBoundary seam = around_a_corner(8, 6);
    EXPECT_FALSE(seam.straight_line(half_metre).has_value());
    const CornerBoundary corner = seam.corner(half_metre).value();
    const bool turned = std::abs(corner.one.along.y) > 0.5;
    const BoundaryLine& below = turned ? corner.other : corner.one;
    const BoundaryLine& beside = turned ? corner.one : corner.other;
    // Of columns 22 to 29, and of rows 14 to 19.
    EXPECT_TRUE(is_near(below.middle, {26 * 0.5, 20 * 0.5}));
    EXPECT_TRUE(is_near(below.inward, {0, -1}));
    EXPECT_NEAR(below.last - below.first, 7 * 0.5, 1e-9);
    EXPECT_TRUE(is_near(beside.middle, {30 * 0.5, 17 * 0.5}));
    EXPECT_TRUE(is_near(beside.inward, {-1, 0}));
}

TEST(SharedBoundary, AShortPieceIsNoWall) {
    EXPECT_TRUE(around_a_corner(20, 4).corner(half_metre).has_value());
    EXPECT_FALSE(around_a_corner(20, 3).corner(half_metre).has_value());
}

TEST(SharedBoundary, AStraightSeamHasNoCorner) {
    const SharedBoundary seam = around_a_corner(20, 0);
    EXPECT_TRUE(seam.straight_line(half_metre).has_value());
    EXPECT_FALSE(seam.corner(half_metre).has_value());
    EXPECT_FALSE(SharedBoundary().corner(half_metre).has_value());
}

}  // namespace
}  // namespace d2b

#include "detect/part_seam.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace d2b {
namespace {

constexpr CellSize half_metre{0.5, 0.5};

/// The seam of a part that lies below row 20 and to the right of column 30 of a roof with its corner there.
PartSeam around_a_corner(std::int32_t below, std::int32_t beside) {
    PartSeam seam;
    for (std::int32_t c = 30 - below; c < 30; ++c)
        seam.add(20, c, -1, 0, half_metre);
    for (std::int32_t r = 20 - beside; r < 20; ++r)
        seam.add(r, 30, 0, -1, half_metre);
    return seam;
}

TEST(PartSeam, HasTwoLinesAroundACorner) {
    const PartSeam seam = around_a_corner(8, 6);
    EXPECT_FALSE(seam.straight_line(half_metre).has_value());
    const std::optional<CornerSeam> corner = seam.corner(half_metre);
    ASSERT_TRUE(corner.has_value());
    const bool turned = std::abs(corner->one.along.y) > 0.5;
    const SeamLine& below = turned ? corner->other : corner->one;
    const SeamLine& beside = turned ? corner->one : corner->other;
    EXPECT_NEAR(below.middle.x, 26 * 0.5, 1e-9);  // of columns 22 to 29
    EXPECT_NEAR(below.middle.y, 20 * 0.5, 1e-9);
    EXPECT_NEAR(below.inward.y, -1, 1e-9);
    EXPECT_NEAR(below.last - below.first, 7 * 0.5, 1e-9);
    EXPECT_NEAR(beside.middle.x, 30 * 0.5, 1e-9);
    EXPECT_NEAR(beside.middle.y, 17 * 0.5, 1e-9);  // of rows 14 to 19
    EXPECT_NEAR(beside.inward.x, -1, 1e-9);
}

TEST(PartSeam, AShortPieceIsNoWall) {
    EXPECT_TRUE(around_a_corner(20, 4).corner(half_metre).has_value());
    EXPECT_FALSE(around_a_corner(20, 3).corner(half_metre).has_value());
}

TEST(PartSeam, AStraightSeamHasNoCorner) {
    const PartSeam seam = around_a_corner(20, 0);
    EXPECT_TRUE(seam.straight_line(half_metre).has_value());
    EXPECT_FALSE(seam.corner(half_metre).has_value());
    EXPECT_FALSE(PartSeam().corner(half_metre).has_value());
}

}  // namespace
}  // namespace d2b

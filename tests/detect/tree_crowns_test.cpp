#include "detect/tree_crowns.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "detect/smoothness.hpp"
#include "detect_case.hpp"

namespace d2b::detect {
namespace {

using namespace test;

constexpr float roof_z = 108;
using Truth = std::function<bool(std::int32_t, std::int32_t)>;

/// Roofs with known cells, and the objects found of them: all that is raised.
struct Leaning {
    explicit Leaning(std::int32_t rows, std::int32_t cols, CellSize cell = {})
        : town(rows, cols, cell), roofs(rows, cols) {}

    void roof(const Truth& inside, float z = roof_z) {
        for (std::int32_t r = 0; r < roofs.rows; ++r)
            for (std::int32_t c = 0; c < roofs.cols; ++c)
                if (inside(r, c)) {
                    roofs.at(r, c) = 1;
                    town.surface.at(r, c) = z;
                }
    }
    void roof(Block block, float z = roof_z) {
        roof([=](auto r,
                 auto c) { return r >= block.top && r < block.bottom && c >= block.left && c < block.right; },
             z);
    }
    /// Leaves of a dome that begin anywhere in its upper half; roofs stand above them.
    void crown(double row, double col, double radius) {
        std::mt19937 random(7);
        for (std::int32_t r = 0; r < roofs.rows; ++r)
            for (std::int32_t c = 0; c < roofs.cols; ++c) {
                const double square = (r - row) * (r - row) + (c - col) * (c - col);
                if (roofs.at(r, c) != 0 || square >= radius * radius)
                    continue;
                const double top = 2.5 + 4 * std::sqrt(1 - square / radius / radius);
                town.surface.at(r, c) =
                    static_cast<float>(100 + top - 0.01 * static_cast<double>(random() % 200));
            }
    }
    /// @return cells of the objects after crowns were taken off
    Mask cut(int thread_count = 2) {
        Executor threads(thread_count);
        const Scene scene = town.scene();
        const Mask elevated = elevated_cells(scene, 0.4, threads);
        const Grid<std::uint8_t> flags =
            smoothness(scene.surface, smoothness_thresholds(scene.side(), {}), threads);
        Candidates judged;
        judged.regions = connected_regions(elevated, 1, 0, threads);
        for (Label label = 1; label <= judged.regions.count(); ++label) {
            judged.objects.push_back({0.25 * label, CounterEvidence::rough, judged.regions.cells[label]});
            judged.features.push_back({});
        }
        crowns = remove_attached_crowns(scene, smooth_segments(scene, elevated, flags, threads), flags, 30,
                                        elevated, judged, threads);
        objects = judged.objects;
        return mask_of(judged.regions, threads);
    }

    Town town;
    Mask roofs;
    std::vector<CutCrown> crowns;
    std::vector<DetectedObject> objects;
};

/// Leaves beside a wall that by chance are as high as the roof.
constexpr std::int64_t leaves_like_a_roof = 2;

/// Cells of a mask that no roof has. All roofs have to be in it.
std::int64_t cells_beside_roofs(const Leaning& place, const Mask& mask) {
    std::int64_t more = 0;
    std::int64_t lost = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        more += mask.values[i] > place.roofs.values[i] ? 1 : 0;
        lost += mask.values[i] < place.roofs.values[i] ? 1 : 0;
    }
    EXPECT_EQ(lost, 0) << "cells of roofs";
    return more;
}

TEST(TreeCrowns, AreCutOffAtTheLineOfAStraightWall) {
    Leaning place(50, 80);
    place.roof(Block{10, 10, 30, 70});
    place.crown(32, 40, 6.5);
    const std::int64_t raised_cells = std::ranges::count(raised(place.town).values, 1);
    EXPECT_LE(cells_beside_roofs(place, place.cut()), leaves_like_a_roof);
    ASSERT_EQ(place.crowns.size(), 1U);
    // All but the row beside the wall, which belongs to the eaves until the line of the wall is known.
    EXPECT_EQ(place.crowns[0].first.row, 31);
    EXPECT_LE(place.crowns[0].cells, raised_cells - 20 * 60);
    EXPECT_GT(place.crowns[0].cells, 60);
    ASSERT_EQ(place.objects.size(), 1U);
    EXPECT_EQ(place.objects[0].confidence, 0.25);
}

TEST(TreeCrowns, AreCutOffASlantedWallWithinACell) {
    const auto depth = [](std::int32_t r, std::int32_t c) { return 0.5 * c + 20 - r; };  // rows
    const Truth inside = [&](std::int32_t r, std::int32_t c) {
        return depth(r, c) > 0 && depth(r, c) < 20 && c > 5 && c < 75;
    };
    Leaning place(80, 80);
    place.roof(inside);
    place.crown(42, 40, 6.5);
    const Mask cut = place.cut();
    ASSERT_EQ(place.crowns.size(), 1U);
    for (std::int32_t r = 0; r < cut.rows; ++r)
        for (std::int32_t c = 0; c < cut.cols; ++c) {
            if (inside(r, c)) {
                EXPECT_EQ(cut.at(r, c), 1) << r << ' ' << c;
            } else if (cut.at(r, c) != 0) {
                EXPECT_GT(depth(r, c), -1.5) << r << ' ' << c;
            }
        }
}

TEST(TreeCrowns, AreCutOffAtBothWallsOfACorner) {
    Leaning place(50, 80);
    place.roof(Block{10, 10, 30, 60});
    place.crown(31, 61, 6.5);
    EXPECT_LE(cells_beside_roofs(place, place.cut()), 2 * leaves_like_a_roof);
    EXPECT_EQ(place.crowns.size(), 1U);
}

/// A crown beside the last metres of a wall, so that it is seen on the other side alone.
Leaning at_the_end_of_a_wall(CellSize cell = {}) {
    Leaning place(50, 80, cell);
    place.roof(Block{10, 10, 30, 60});
    place.crown(33, 55, 6.5);
    return place;
}

TEST(TreeCrowns, AreCutOffWhereTheyHideTheEndOfAWall) {
    Leaning place = at_the_end_of_a_wall();
    EXPECT_LE(cells_beside_roofs(place, place.cut()), 2 * leaves_like_a_roof);
    EXPECT_EQ(place.crowns.size(), 1U);
}

TEST(TreeCrowns, StayAtTheEndOfAWallThatIsFewCellsLong) {
    Leaning place = at_the_end_of_a_wall({2, 2});
    EXPECT_EQ(drawing(place.cut()), drawing(raised(place.town)));
}

TEST(TreeCrowns, AWingAtTheEndOfAWallStays) {
    Leaning place(50, 80);
    place.roof(Block{10, 10, 30, 60});
    place.roof(Block{30, 52, 35, 60}, 105);
    EXPECT_EQ(drawing(place.cut()), drawing(place.roofs));
}

TEST(TreeCrowns, NothingIsCutWhereNoWallGoesOnFromTheCorner) {
    Leaning place(50, 80);
    place.roof(Block{10, 10, 30, 60});
    place.crown(31, 61, 6.5);
    place.roof(Block{30, 44, 40, 54}, 105);  // a wing in the way of one of the two
    const Mask before = raised(place.town);
    const Mask cut = place.cut();
    EXPECT_EQ(cut.at(32, 63), before.at(32, 63));
}

TEST(TreeCrowns, ATreeBetweenTwoBuildingsStays) {
    Leaning place(60, 80);
    place.roof(Block{5, 10, 24, 70});
    place.roof(Block{33, 10, 52, 70});
    place.crown(28, 40, 7);
    EXPECT_EQ(drawing(place.cut()), drawing(raised(place.town)));
}

TEST(TreeCrowns, TowersAndBaysOfAWallStay) {
    Leaning place(50, 90);
    place.roof(Block{10, 10, 30, 80});
    place.roof([](auto r, auto c) { return (r - 31) * (r - 31) + (c - 30) * (c - 30) < 20; }, 112);
    place.roof(Block{30, 55, 33, 62}, 105);
    EXPECT_EQ(drawing(place.cut()), drawing(place.roofs));
}

TEST(TreeCrowns, ARoundTowerStaysRound) {
    Leaning place(50, 50);
    place.roof([](auto r, auto c) { return (r - 24) * (r - 24) + (c - 24) * (c - 24) < 150; });
    EXPECT_EQ(drawing(place.cut()), drawing(place.roofs));
    place.crown(38, 24, 5);
    EXPECT_LE(cells_beside_roofs(place, place.cut()), 80);  // the whole crown
}

TEST(TreeCrowns, WhatIsLeftKeepsItsConfidenceAndWhatStandsInACrownGoesWithIt) {
    Leaning place(60, 90);
    place.roof(Block{2, 2, 9, 9});  // the first object: others have other confidences
    place.roof(Block{20, 10, 40, 80});
    place.crown(43, 40, 6.5);
    place.roof(Block{48, 38, 50, 42}, 104);  // a shed of eight cells on the other side of the crown
    const Mask cut = place.cut();
    ASSERT_EQ(place.objects.size(), 2U);
    EXPECT_EQ(place.objects[0].confidence, 0.25);
    EXPECT_EQ(place.objects[1].confidence, 0.5);
    EXPECT_LE(place.objects[1].cells, 20 * 70 + leaves_like_a_roof);
    EXPECT_EQ(cut.at(49, 40), 0);
}

TEST(TreeCrowns, AreTheSameOnAnyNumberOfThreadsAndTurned) {
    Leaning place(90, 80);
    place.roof(Block{10, 10, 30, 70});
    place.crown(32, 30, 6.5);
    place.crown(7, 50, 5.5);
    const Mask one = place.cut(1);
    EXPECT_EQ(one.values, place.cut(5).values);
    place.town.surface = flipped(place.town.surface);
    EXPECT_EQ(drawing(place.cut()), drawing(flipped(one)));
}

}  // namespace
}  // namespace d2b::detect

namespace d2b::detect {
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
}  // namespace d2b::detect

#include "geometry/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "geometry/geos.hpp"
#include "score/measure.hpp"
#include "support/box.hpp"

namespace d2b {
namespace {

using test::box;

double length(const std::vector<Polyline>& lines) {
    double sum = 0;
    for (const Polyline& line : lines)
        for (std::size_t i = 1; i < line.size(); ++i)
            sum += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
    return sum;
}

TEST(Overlay, tellsWhatIsValid) {
    Overlay overlay;
    EXPECT_TRUE(overlay.valid({box(0, 0, 1, 1)}));
    EXPECT_TRUE(overlay.valid({box(0, 0, 1, 1), box(1, 1, 2, 2)}));   // touch in a point
    EXPECT_FALSE(overlay.valid({box(0, 0, 2, 2), box(1, 1, 3, 3)}));  // overlap
    EXPECT_FALSE(overlay.valid({{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}}}));
    EXPECT_FALSE(overlay.valid({{{{0, 0}, {1, 1}}, {}}}));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(overlay.valid({{{{0, 0}, {1, nan}, {1, 1}}, {}}}));
    EXPECT_FALSE(overlay.valid({{{{0, 0}, {4, 0}, {4, 4}}, {{{1, 1}}}}}));
}

TEST(Overlay, makesABowTieTwoTriangles) {
    Overlay overlay;
    const Polygons made = overlay.make_valid({{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}}});
    EXPECT_EQ(made.size(), 2U);
    EXPECT_DOUBLE_EQ(score::area_of(made), 2);  // two triangles with a base of 2 and a height of 1
    EXPECT_TRUE(overlay.valid(made));
}

TEST(Overlay, repairsAsTheOutputIsRepaired) {
    Overlay overlay;
    const Polygons overlapping{box(0, 0, 2, 2), box(1, 1, 3, 3)};
    EXPECT_NEAR(score::area_of(overlay.make_valid(overlapping)), 4 + 4 - 1, 1e-12);
    const Polygons hole_outside{{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{3, 1}, {3, 3}, {6, 3}, {6, 1}}}}};
    EXPECT_NEAR(score::area_of(overlay.make_valid(hole_outside)), 16 - 2, 1e-12);
    for (const Polygons& polygons : {overlapping, hole_outside})
        EXPECT_EQ(score::area_of(Geos().repaired(polygons)), score::area_of(overlay.make_valid(polygons)));
}

TEST(Overlay, leavesOutWhatBoundsNothing) {
    Overlay overlay;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(overlay.make_valid({{{{0, 0}, {1, 1}}, {}}}).empty());
    EXPECT_TRUE(overlay.make_valid({}).empty());
    // The position that is not finite goes, a triangle stays; so goes the hole of one point.
    const Polygons made = overlay.make_valid({{{{0, 0}, {4, 0}, {nan, 1}, {0, 4}}, {{{1, 1}}}}});
    EXPECT_DOUBLE_EQ(score::area_of(made), 8);
}

TEST(Overlay, dissolvesAndTellsWhatIsCoveredTwice) {
    Overlay overlay;
    // Three squares of 4 by 4 in a row, each 1 over the next; one more apart; one within the first.
    const std::vector<Polygons> features{
        {box(0, 0, 4, 4)}, {box(3, 0, 7, 4)}, {box(6, 0, 10, 4)}, {box(20, 0, 24, 4)}, {}, {box(1, 1, 2, 2)}};
    const Dissolved dissolved = overlay.dissolve(features);
    EXPECT_EQ(dissolved.once.size(), 2U);
    EXPECT_NEAR(score::area_of(dissolved.once), 40 + 16, 1e-12);
    EXPECT_NEAR(score::area_of(dissolved.twice), 4 + 4 + 1, 1e-12);
    EXPECT_NEAR(score::area_of(overlay.union_of(features)), 56, 1e-12);
}

TEST(Overlay, simplifiesRingsFromTheirFirstVertex) {
    Overlay overlay;
    const WorldRing wavy{{0, 0}, {5, 0.04}, {10, 0}, {10, 5}, {10, 10}, {5, 9.9}, {0, 10}};
    EXPECT_EQ(overlay.simplified_ring(wavy, 0.05), (WorldRing{{0, 0}, {10, 0}, {10, 10}, {5, 9.9}, {0, 10}}));
    // A ring that is smaller than the tolerance stays a ring.
    EXPECT_GE(overlay.simplified_ring({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 5).size(), 3U);
}

TEST(Overlay, countsWhatThreeCoverOnce) {
    Overlay overlay;
    const std::vector<Polygons> features(3, Polygons{box(0, 0, 2, 3)});
    const Dissolved dissolved = overlay.dissolve(features);
    EXPECT_NEAR(score::area_of(dissolved.once), 6, 1e-12);
    EXPECT_NEAR(score::area_of(dissolved.twice), 6, 1e-12);
}

TEST(Overlay, takesWallsOutAndKeepsCornersApart) {
    Overlay overlay;
    const std::vector<Polygons> walls{{box(0, 0, 1, 1)}, {box(1, 0, 2, 1)}, {box(0, 1, 1, 2)}};
    EXPECT_EQ(overlay.dissolve(walls).once.size(), 1U);
    EXPECT_TRUE(overlay.dissolve(walls).twice.empty());
    const std::vector<Polygons> corners{{box(0, 0, 1, 1)}, {box(1, 1, 2, 2)}};
    EXPECT_EQ(overlay.dissolve(corners).once.size(), 2U);
}

TEST(Overlay, dissolvesAChessboardOfManyToItsArea) {
    Overlay overlay;
    std::vector<Polygons> features;
    for (int row = 0; row < 40; ++row)
        for (int col = 0; col < 40; ++col)
            features.push_back({box(2.0 * col, 2.0 * row, 2.0 * col + 3, 2.0 * row + 2)});
    const Dissolved dissolved = overlay.dissolve(features);  // each reaches 1 into its right neighbour
    EXPECT_EQ(dissolved.once.size(), 1U);
    EXPECT_NEAR(score::area_of(dissolved.once), 81.0 * 80, 1e-9);
    EXPECT_NEAR(score::area_of(dissolved.twice), 39.0 * 40 * 2, 1e-9);
}

TEST(Overlay, dissolvesNothing) {
    Overlay overlay;
    EXPECT_TRUE(overlay.dissolve({}).once.empty());
    EXPECT_TRUE(overlay.intersection({}, {box(0, 0, 1, 1)}).empty());
}

TEST(Overlay, repairsBeforeItUnites) {
    Overlay overlay;
    const Polygons parts{{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}}, box(0, 0, 2, 2)};
    EXPECT_NEAR(score::area_of(overlay.repaired_union(parts)), 4, 1e-12);
}

TEST(Overlay, intersectsWithoutLinesAndPoints) {
    Overlay overlay;
    const Polygons a{box(0, 0, 4, 4), box(10, 0, 12, 2)};
    const Polygons b{box(2, 2, 10, 6)};  // shares an edge point with the second
    const Polygons both = overlay.intersection(a, b);
    EXPECT_EQ(both.size(), 1U);
    EXPECT_DOUBLE_EQ(score::area_of(both), 4);
}

TEST(Overlay, cutsRings) {
    Overlay overlay;
    const Polygons frame{{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{{2, 2}, {2, 8}, {8, 8}, {8, 2}}}}};
    // Of the outer ring 5 + 10 + 5, of the inner one 3 + 6 + 3.
    EXPECT_NEAR(length(overlay.clip_rings(frame, {box(5, -1, 11, 11)})), 32, 1e-12);
    EXPECT_NEAR(length(overlay.clip_rings(frame, {box(0, 0, 10, 10)})), 64, 1e-12);  // the border, too
}

TEST(Overlay, tellsWhatTouches) {
    Overlay overlay;
    const std::vector<Polygons> features{{box(0, 0, 1, 1)}, {box(1, 1, 2, 2)}, {box(3, 3, 4, 4)}, {}};
    EXPECT_EQ(overlay.intersecting(features, {box(-1, -1, 1, 1)}),
              (std::vector<bool>{true, true, false, false}));
}

TEST(Overlay, findsWhatHoldsAPolygon) {
    Overlay overlay;
    const Polygons outers{{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{{2, 2}, {2, 8}, {8, 8}, {8, 2}}}},
                          box(3, 3, 7, 7)};
    const Polygons inners{box(0, 0, 1, 1), box(4, 4, 5, 5), box(7.2, 7.2, 7.8, 7.8)};
    const auto containing_polygons = overlay.containing_polygons(inners, outers);
    ASSERT_EQ(containing_polygons.size(), 3U);
    EXPECT_EQ(containing_polygons[0], 0U);
    EXPECT_EQ(containing_polygons[1], 1U);
    EXPECT_FALSE(containing_polygons[2]);  // in the courtyard, beside the box in it
}

TEST(Overlay, countsVerticesAfterSimplification) {
    Overlay overlay;
    // Two of the six vertices are 0.01 off the edges they stand on.
    const Polygons square{{{{0, 0}, {5, 0.01}, {10, 0}, {10, 10}, {5, 9.99}, {0, 10}}, {}}};
    EXPECT_EQ(overlay.simplified_vertices(square, 0.05), 5U);
    EXPECT_EQ(overlay.simplified_vertices(square, 0.001), 7U);
}

TEST(Overlay, keepsPositionsOfLargeCoordinates) {
    Overlay overlay;
    const Polygons both = overlay.intersection({box(13290000.125, 280000, 13290010, 280010)},
                                               {box(13290005.25, 280000, 13290020, 280010)});
    ASSERT_EQ(both.size(), 1U);
    EXPECT_TRUE(std::ranges::find(both[0].exterior, Position{13290005.25, 280000}) != both[0].exterior.end());
    EXPECT_DOUBLE_EQ(score::area_of(both), 47.5);
}

}  // namespace
}  // namespace d2b

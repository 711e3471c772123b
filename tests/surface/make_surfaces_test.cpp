#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "surface/label_contours.hpp"
#include "surface/surface_check.hpp"

namespace d2b::surface {
namespace {

constexpr Int128 square_cell = Int128{FinePoint::steps} * FinePoint::steps;

/// Checks that hold for any: both forms closed, and of the area and the volume that the cells have.
void expect_whole(const MadeSurfaces& made, int cells, Int128 cell_heights, Int128 shell_heights) {
    EXPECT_TRUE(made.left_out.empty());
    EXPECT_TRUE(made.repairs.empty());
    EXPECT_EQ(fault_of(made.shell), "");
    for (const SurfacePart& solid : made.solids)
        EXPECT_EQ(fault_of({&solid, 1}), "");
    for (const auto* parts : {&made.shell, &made.solids}) {
        EXPECT_TRUE(twice_plan_area(*parts, FaceKind::roof) == 2 * cells * square_cell);
        EXPECT_TRUE(twice_plan_area(*parts, FaceKind::ground) == 2 * cells * square_cell);
    }
    EXPECT_TRUE(six_volumes(made.solids) == 6 * cell_heights * square_cell);
    EXPECT_TRUE(six_volumes(made.shell) == 6 * shell_heights * square_cell);
}

std::size_t walls_of(const SurfacePart& part) {
    std::size_t walls = 0;
    for (const SurfaceBuilding& building : part.buildings)
        for (const SurfaceFace& face : building.faces)
            walls += face.kind == FaceKind::wall ? 1 : 0;
    return walls;
}

TEST(MakeSurfaces, aBlockHasEightCorners) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"aa", "aa"}}, {30}));
    expect_whole(made, 4, 4 * 30, 4 * 30);
    ASSERT_EQ(made.solids.size(), 1U);
    EXPECT_EQ(made.solids[0].points.size(), 8U);
    EXPECT_EQ(walls_of(made.solids[0]), 4U);
    ASSERT_EQ(made.shell.size(), 1U);
    EXPECT_EQ(made.shell[0].points.size(), 8U);
    ASSERT_EQ(made.shell[0].buildings.size(), 1U);
    EXPECT_EQ(made.shell[0].buildings[0].id, 100);
    EXPECT_EQ(made.shell[0].buildings[0].triangles.size(), 12U);
}

/// Two houses: the wall between them shows above the lower roof alone, and not at all where they are equal.
TEST(MakeSurfaces, aPartyWallOfTwoHeights) {
    for (const std::int64_t other : {10, 29, 30, 31, 75}) {
        const MadeSurfaces made = surfaces_of(blocks_of({{"ab"}}, {30, other}));
        expect_whole(made, 2, 30 + other, 30 + other);
        ASSERT_EQ(made.shell.size(), 1U);
        ASSERT_EQ(made.shell[0].buildings.size(), 2U);
        // 6 corners on the ground, and the ends of each roof
        EXPECT_EQ(made.shell[0].points.size(), other == 30 ? 12U : 14U);
        std::size_t triangles = 0;
        for (const SurfaceBuilding& building : made.shell[0].buildings)
            triangles += building.triangles.size();
        EXPECT_EQ(triangles, 2 * made.shell[0].points.size() - 4);  // Euler's, of surfaces without a handle
        ASSERT_EQ(made.solids.size(), 2U);
        EXPECT_EQ(made.solids[0].points.size(), 8U);
        EXPECT_EQ(made.solids[1].points.size(), 8U);
    }
}

/// A block on a slope stands at its lowest ground, and each solid at its own.
TEST(MakeSurfaces, basesOfTwoHeights) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"ab"}}, {30, 40}, {5, 12}));
    expect_whole(made, 2, 25 + 28, 25 + 35);
    for (const auto& [x, y, z] : made.shell[0].points)
        EXPECT_TRUE(z == 5 || z == 30 || z == 40) << z;
    for (const auto& [x, y, z] : made.solids[1].points)
        EXPECT_TRUE(z == 12 || z == 40) << z;
}

/// The roof of one may lie below the ground of the other.
TEST(MakeSurfaces, aRoofBelowTheNextGround) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"ab"}}, {30, 90}, {5, 50}));
    expect_whole(made, 2, 25 + 40, 25 + 85);
}

TEST(MakeSurfaces, aTowerInABlock) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"aaa", "aba", "aaa"}}, {20, 80}));
    expect_whole(made, 9, 8 * 20 + 80, 8 * 20 + 80);
    ASSERT_EQ(made.shell.size(), 1U);
    // Both have their borders on the ground, because each has a ground of its own.
    EXPECT_EQ(made.shell[0].points.size(), 2U * 4 + 3 * 4);
}

TEST(MakeSurfaces, aCourtyard) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"aaa", "a a", "aaa"}}, {20}));
    expect_whole(made, 8, 8 * 20, 8 * 20);
    EXPECT_EQ(made.shell[0].points.size(), 16U);
    ASSERT_EQ(made.solids[0].buildings[0].faces.size(), 8U + 2U);
    EXPECT_EQ(made.solids[0].buildings[0].faces.front().interiors.size(), 1U);
}

/// Three houses around a corner: the highest wall has a corner where the middle roof ends.
TEST(MakeSurfaces, aWallHasACornerWhereARoofBesideItEnds) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"ab", "cc"}}, {20, 50, 80}));
    expect_whole(made, 4, 20 + 50 + 2 * 80, 20 + 50 + 2 * 80);
    std::size_t in_the_middle = 0;
    for (const SurfacePoint& p : made.shell[0].points)
        in_the_middle += p.x == FinePoint::steps && p.y == -FinePoint::steps && p.z == 50 ? 1 : 0;
    EXPECT_EQ(in_the_middle, 1U);
}

/// Corners of a neighbour on a straight wall are corners of the shell, and of no solid but its own.
TEST(MakeSurfaces, solidsHaveNoCornersOfTheirNeighbours) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"aaa", " b "}}, {20, 30}));
    expect_whole(made, 4, 3 * 20 + 30, 3 * 20 + 30);
    for (const SurfacePart& solid : made.solids)
        EXPECT_EQ(solid.points.size(), 8U);
    EXPECT_EQ(made.shell[0].points.size(), 8U + 2 + 8U);
}

/// Each is a part of its own with its own base.
TEST(MakeSurfaces, whatDoesNotTouchIsApart) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"a b", "   ", "ccc"}}, {20, 30, 40}, {1, 2, 3}));
    expect_whole(made, 5, 19 + 28 + 3 * 37, 19 + 28 + 3 * 37);
    EXPECT_EQ(made.shell.size(), 3U);
}

/// Tiers of a stack: one building, one ground, and no walls inside.
TEST(MakeSurfaces, aStack) {
    const MadeSurfaces made = surfaces_of(stacks_of({{"11111", "12221", "12321", "12221", "11111"}}));
    expect_whole(made, 25, 16 * 10 + 8 * 20 + 30, 16 * 10 + 8 * 20 + 30);
    ASSERT_EQ(made.shell.size(), 1U);
    EXPECT_EQ(made.shell[0].points.size(), 4U + 4 + 8 + 8);
    ASSERT_EQ(made.solids.size(), 1U);
    EXPECT_EQ(made.solids[0].points.size(), made.shell[0].points.size());
}

/// Stacks that share walls with a neighbour or with the tier below.
TEST(MakeSurfaces, stacksWithCommonWalls) {
    const MadeSurfaces made = surfaces_of(stacks_of({{"333", "321", "123"}}));
    expect_whole(made, 9, 10 * (9 + 6 + 6), 10 * (9 + 6 + 6));
}

/// A roof that is no higher than the ground encloses nothing.
TEST(MakeSurfaces, whatHasNoHeightIsNotThere) {
    SurfaceCluster cluster = blocks_of({{"ab"}}, {20, 30}, {0, 30});
    MadeSurfaces made = surfaces_of(cluster);
    EXPECT_TRUE(six_volumes(made.shell) == 6 * 20 * square_cell);
    EXPECT_EQ(made.solids.size(), 1U);
    EXPECT_EQ(fault_of(made.shell), "");
    cluster.contours[0].top = -5;
    made = surfaces_of(cluster);
    EXPECT_TRUE(made.shell.empty());
    EXPECT_TRUE(made.solids.empty());
}

/// A grid that is turned by the angle of 3 to 4, where no edge is parallel to an axis.
TEST(MakeSurfaces, aTurnedGrid) {
    SurfaceCluster cluster = blocks_of({{"aab", "acb", "ccc"}}, {20, 50, 35});
    for (PartitionContour& contour : cluster.contours) {
        const auto turn = [](FineRing& ring) {
            for (FinePoint& p : ring)
                p = {3 * p.row - 4 * p.col, 4 * p.row + 3 * p.col};
        };
        turn(contour.outline.exterior);
    }
    const MadeSurfaces made = surfaces_of(cluster);
    expect_whole(made, 9 * 25, 25 * (3 * 20 + 2 * 50 + 4 * 35), 25 * (3 * 20 + 2 * 50 + 4 * 35));
}

/// Only the requested form is made.
TEST(MakeSurfaces, oneFormAlone) {
    const SurfaceCluster cluster = blocks_of({{"ab"}}, {20, 30});
    const MadeSurfaces solids = make_surfaces(cluster, {true, false}, with_geos);
    EXPECT_EQ(solids.solids.size(), 2U);
    EXPECT_TRUE(solids.shell.empty());
    const MadeSurfaces shell = make_surfaces(cluster, {false, true}, with_geos);
    EXPECT_EQ(shell.shell.size(), 1U);
    EXPECT_TRUE(shell.solids.empty());
}

LetterGrid random_grid(std::mt19937& random, const std::string& letters) {
    const auto up_to = [&](unsigned most) { return static_cast<int>(random() % most); };
    LetterGrid grid;
    const int rows = 1 + up_to(9);
    const int cols = 1 + up_to(9);
    for (int row = 0; row < rows; ++row) {
        std::string& line = grid.rows.emplace_back();
        for (int col = 0; col < cols; ++col)
            line += letters[static_cast<std::size_t>(up_to(static_cast<unsigned>(letters.size())))];
    }
    return grid;
}

/// Grid as text, for messages.
std::string shown(const LetterGrid& grid) {
    std::string text = "\n";
    for (const std::string& row : grid.rows)
        text += row + "|\n";
    return text;
}

/// Whatever the grid: both forms are closed, nothing is left out, and areas and volumes are those of the
/// cells but for the parts that mends take.
void expect_surfaces(const LetterGrid& grid, const SurfaceCluster& cluster, double cells, double heights) {
    const MadeSurfaces made = surfaces_of(cluster);
    ASSERT_EQ(fault_of(made.shell), "") << shown(grid);
    for (const SurfacePart& solid : made.solids)
        ASSERT_EQ(fault_of({&solid, 1}), "") << shown(grid);
    ASSERT_TRUE(made.left_out.empty()) << shown(grid);
    constexpr double cell = static_cast<double>(FinePoint::steps) * static_cast<double>(FinePoint::steps);
    // A mend moves a corner by two steps, and with it edges of some cells.
    const double slack = 0.01 * static_cast<double>(made.repairs.size()) * 4;
    ASSERT_NEAR(static_cast<double>(twice_plan_area(made.shell, FaceKind::roof)) / 2 / cell, cells, slack)
        << shown(grid);
    ASSERT_NEAR(static_cast<double>(six_volumes(made.shell)) / 6 / cell, heights, 100 * slack) << shown(grid);
    ASSERT_NEAR(static_cast<double>(six_volumes(made.solids)) / 6 / cell, heights, 100 * slack)
        << shown(grid);
    if (made.repairs.empty()) {
        ASSERT_EQ(static_cast<double>(six_volumes(made.shell)), 6 * cell * heights);
    }
}

TEST(RandomGrids, blocks) {
    std::mt19937 random(1);
    const std::vector<std::int64_t> heights{20, 35, 35, 60};
    for (int run = 0; run < 700; ++run) {
        const LetterGrid grid = random_grid(random, run % 2 == 0 ? "abcd" : "ab  c");
        double cells = 0;
        double sum = 0;
        for (const std::string& row : grid.rows)
            for (const char letter : row)
                if (letter != ' ') {
                    ++cells;
                    sum += static_cast<double>(heights[static_cast<std::size_t>(letter - 'a')]);
                }
        expect_surfaces(grid, blocks_of(grid, heights), cells, sum);
    }
}

TEST(RandomGrids, stacks) {
    std::mt19937 random(2);
    for (int run = 0; run < 700; ++run) {
        const LetterGrid grid = random_grid(random, run % 3 == 0 ? "123" : run % 3 == 1 ? "0124" : "111152");
        double cells = 0;
        double sum = 0;
        for (const std::string& row : grid.rows)
            for (const char digit : row) {
                cells += digit > '0' ? 1 : 0;
                sum += 10 * (digit - '0');
            }
        expect_surfaces(grid, stacks_of(grid), cells, sum);
    }
}

}  // namespace
}  // namespace d2b::surface

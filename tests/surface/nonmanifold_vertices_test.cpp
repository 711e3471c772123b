#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "surface/label_contours.hpp"
#include "surface/partition.hpp"
#include "surface/planar_partition.hpp"
#include "surface/surface_check.hpp"

namespace d2b::surface {
namespace {

struct Sums {
    double roofs;
    double volume;
};

/// Sums in cells and heights of cells.
Sums sums_of(const std::vector<SurfacePart>& parts) {
    constexpr double cell = static_cast<double>(FinePoint::steps) * static_cast<double>(FinePoint::steps);
    return {static_cast<double>(twice_plan_area(parts, FaceKind::roof)) / 2 / cell,
            static_cast<double>(six_volumes(parts)) / 6 / cell};
}

/// Both forms are closed, and little has changed.
void expect_mended(const MadeSurfaces& made, double cells, double shell_volume, std::size_t filled,
                   std::size_t cut) {
    std::size_t fills = 0;
    for (const VertexRepair& mend : made.repairs)
        fills += mend.filled ? 1 : 0;
    EXPECT_EQ(fills, filled);
    EXPECT_EQ(made.repairs.size() - fills, cut);
    EXPECT_TRUE(made.left_out.empty());
    EXPECT_EQ(fault_of(made.shell), "");
    for (const SurfacePart& solid : made.solids)
        EXPECT_EQ(fault_of({&solid, 1}), "");
    const Sums sums = sums_of(made.shell);
    // A corner of a cell that moves by two steps takes some two thousandths of the cell.
    const double slack = 0.004 * static_cast<double>(made.repairs.size());
    EXPECT_NEAR(sums.roofs, cells, slack);
    EXPECT_NEAR(sums.volume, shell_volume, 90 * slack);
}

/// Two houses that touch in a corner are cut back from each other.
TEST(NonmanifoldVertices, housesThatTouchInACorner) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"a ", " b"}}, {20, 30}));
    expect_mended(made, 2, 50, 0, 1);
    EXPECT_EQ(made.shell.size(), 2U);
    EXPECT_LT(sums_of(made.shell).roofs, 2);
    ASSERT_EQ(made.repairs.size(), 1U);
    EXPECT_EQ(made.repairs[0].place, fine(LatticePoint{1, 1}));
    EXPECT_EQ(made.repairs[0].contours, (std::vector<std::int32_t>{0, 1}));
}

/// Where more is wanted a corner moves that far, and the long walls beside it stay where they are but for its
/// neighbourhood.
TEST(NonmanifoldVertices, asFarAsIsWanted) {
    const SurfaceCluster cluster = blocks_of({{"a ", " a"}}, {10});
    PlanarPartition plan = make_partition(cluster.contours).plan;
    const ResolvedVertices taken = resolve_nonmanifold_vertices(plan, cluster.contours, {300});
    EXPECT_TRUE(taken.unresolved.empty());
    ASSERT_EQ(taken.repairs.size(), 1U);
    const VertexRepair& mend = taken.repairs.front();
    EXPECT_NEAR(std::hypot(mend.moved.row - mend.place.row, mend.moved.col - mend.place.col), 300, 1);
    // A node on the two walls that move, where a line across the corner at 300 steps cuts them off, and the
    // corner that moved.
    EXPECT_EQ(plan.nodes.size(), 7U + 2 + 1);
    const auto has = [&](std::int64_t row, std::int64_t col) {
        return std::ranges::count(plan.nodes, FinePoint{mend.place.row + row, mend.place.col + col}) == 1;
    };
    EXPECT_TRUE((has(-424, 0) && has(0, -424)) || (has(424, 0) && has(0, 424)));
}

/// Corners of a surface as seen from above, each once.
std::vector<FinePoint> corners_of(const std::vector<SurfacePart>& parts) {
    std::vector<FinePoint> corners;
    for (const SurfacePart& part : parts)
        for (const SurfacePoint& point : part.points)
            corners.push_back({-point.y, point.x});
    std::ranges::sort(corners);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return corners;
}

/// Corners that are not a gap apart.
std::size_t near_corners(const std::vector<SurfacePart>& parts, const LatticeDistance& gap) {
    const std::vector<FinePoint> corners = corners_of(parts);
    std::size_t near = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            near += gap.parts(corners[i], corners[j]) ? 0U : 1U;
    return near;
}

/// Corners that touch are a gap apart afterwards, along rows or along columns: of cells of 0.5, 0.1 and 30 m,
/// and of cells that are not square.
TEST(NonmanifoldVertices, areAGapApart) {
    for (const CellSize& cell :
         {CellSize{0.5, 0.5}, CellSize{0.1, 0.1}, CellSize{30, 30}, CellSize{0.2, 0.5}, CellSize{2.5, 0.1}}) {
        const GapTolerances gaps = gap_tolerances(cell);
        for (const LetterGrid& grid : {LetterGrid{{"a ", " b"}}, LetterGrid{{"aaa", "a a", "aa ", "a  "}},
                                       LetterGrid{{"aaaa", "a aa", "aa a", "aaaa"}}, LetterGrid{{"ab", "cd"}},
                                       LetterGrid{{"a a a a", " a a a ", "a a a a", " a a a "}}}) {
            const MadeSurfaces made = surfaces_of(blocks_of(grid, {50, 20, 20, 60}), gaps);
            EXPECT_FALSE(made.repairs.empty());
            EXPECT_TRUE(made.left_out.empty());
            for (const VertexRepair& mend : made.repairs)
                EXPECT_TRUE(gaps.pinch.parts(mend.place, mend.moved));
            EXPECT_EQ(fault_of(made.shell), "");
            EXPECT_EQ(near_corners(made.shell, gaps.pinch), 0U) << cell.across << " " << cell.down;
        }
    }
}

/// A house stands where the corner would move to: it goes elsewhere, and is as far from that as from the
/// corner.
TEST(NonmanifoldVertices, doNotComeNearOthers) {
    SurfaceCluster cluster = blocks_of({{"a ", " b"}}, {20, 30});
    // The ground between them, on both sides, has a corner some 12 steps from where one would be cut back.
    const FinePoint middle = fine(LatticePoint{1, 1});
    const auto add = [&](const FineRing& ring, std::int32_t parent) {
        const auto building = static_cast<std::int32_t>(cluster.buildings.size());
        cluster.buildings.push_back({200 + building, 0});
        cluster.contours.push_back({{ring, {}}, parent, building, 10});
    };
    add({{middle.row + 12, middle.col - 12},
         {middle.row + 500, middle.col - 400},
         {middle.row + 500, middle.col - 300}},
        -1);
    const GapTolerances gaps{{21, 21}, {3, 3}};
    const MadeSurfaces made = surfaces_of(cluster, gaps);
    ASSERT_EQ(made.repairs.size(), 1U);
    EXPECT_TRUE(made.left_out.empty());
    EXPECT_EQ(fault_of(made.shell), "");
    EXPECT_TRUE(gaps.pinch.parts(made.repairs[0].place, made.repairs[0].moved));
    EXPECT_TRUE(gaps.pinch.parts({middle.row + 12, middle.col - 12}, made.repairs[0].moved));
}

/// Where cells are no larger than the gap there is no room for it: the corner moves by as much as there is,
/// by no less than the distance at which two are taken for one.
TEST(NonmanifoldVertices, whereThereIsNoRoomForTheGap) {
    const GapTolerances gaps{{2000, 2000}, {100, 100}};
    const MadeSurfaces made = surfaces_of(blocks_of({{"a a", " a ", "a a"}}, {20}), gaps);
    EXPECT_TRUE(made.left_out.empty());
    ASSERT_EQ(made.repairs.size(), 4U);
    for (const VertexRepair& mend : made.repairs)
        EXPECT_TRUE(gaps.corners.parts(mend.place, mend.moved));
    EXPECT_EQ(fault_of(made.shell), "");
    EXPECT_EQ(near_corners(made.shell, gaps.corners), 0U);
}

/// Also where they stand at heights that have nothing in common: their edges would meet.
TEST(NonmanifoldVertices, housesAtOtherHeightsThatTouchInACorner) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"a ", " b"}}, {20, 90}, {0, 20}));
    expect_mended(made, 2, 20 + 70, 0, 1);
}

/// A house that touches itself in a corner: the notch is filled.
TEST(NonmanifoldVertices, aHouseThatTouchesItself) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"aaa", "a a", "aa ", "a  "}}, {20}));
    expect_mended(made, 8, 160, 1, 0);
    EXPECT_GT(sums_of(made.shell).roofs, 8);
}

/// Courtyards that touch each other in a corner are within a house: it is joined there.
TEST(NonmanifoldVertices, courtyardsThatTouch) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"aaaa", "a aa", "aa a", "aaaa"}}, {20}));
    expect_mended(made, 14, 280, 1, 0);
    ASSERT_EQ(made.solids.size(), 1U);
    EXPECT_GT(sums_of(made.shell).roofs, 14);
}

/// Two high roofs and two low ones around a point, of four houses.
TEST(NonmanifoldVertices, highAndLowRoofsTakeTurns) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"ab", "cd"}}, {50, 20, 20, 60}));
    expect_mended(made, 4, 150, 0, 1);
    EXPECT_EQ(made.shell.size(), 1U);
}

/// The two high ones are one house, which goes around: its notch is filled.
TEST(NonmanifoldVertices, aHouseAroundALowerOne) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"aaa", "aba", "caa"}}, {50, 20, 20}));
    expect_mended(made, 9, 7 * 50 + 2 * 20, 1, 0);
}

/// Nothing sticks out of the block at this point, but the solid of the lower house would touch itself.
TEST(NonmanifoldVertices, aHouseThatTouchesItselfBesideOthers) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"aaa", "aba", "caa"}}, {20, 50, 10}));
    expect_mended(made, 9, 7 * 20 + 50 + 10, 1, 0);
}

/// Tiers of one stack.
TEST(NonmanifoldVertices, tiersThatTouchInACorner) {
    const MadeSurfaces made = surfaces_of(stacks_of({{"1111", "1211", "1121", "1111"}}));
    expect_mended(made, 16, 14 * 10 + 2 * 20, 1, 0);
}

/// Every inner corner of a checkerboard is one.
TEST(NonmanifoldVertices, aCheckerboard) {
    for (const int size : {3, 6, 11}) {
        LetterGrid grid;
        for (int row = 0; row < size; ++row) {
            std::string& line = grid.rows.emplace_back();
            for (int col = 0; col < size; ++col)
                line += (row + col) % 2 == 0 ? 'a' : ' ';
        }
        const MadeSurfaces made = surfaces_of(blocks_of(grid, {20}));
        const double cells = (size * size + 1) / 2;
        expect_mended(made, cells, 20 * cells, 0, static_cast<std::size_t>((size - 1) * (size - 1)));
    }
}

/// The same with roofs instead of ground.
TEST(NonmanifoldVertices, aCheckerboardOfRoofs) {
    LetterGrid grid;
    for (int row = 0; row < 8; ++row) {
        std::string& line = grid.rows.emplace_back();
        for (int col = 0; col < 8; ++col)
            line += (row + col) % 2 == 0 ? 'a' : 'b';
    }
    const MadeSurfaces made = surfaces_of(blocks_of(grid, {20, 70}));
    expect_mended(made, 64, 32 * 20 + 32 * 70, 0, 49);
}

/// Thin wedges from eight sides: where two steps do not fit into an angle the corner moves farther.
TEST(NonmanifoldVertices, wedgesAroundAPoint) {
    SurfaceCluster cluster;
    const std::vector<FinePoint> rim{{0, -2000}, {60, -2000}, {2000, -60}, {2000, 0},
                                     {60, 2000}, {0, 2000},   {-2000, 60}, {-2000, 0}};
    for (std::size_t i = 0; i < rim.size(); i += 2) {
        const auto building = static_cast<std::int32_t>(cluster.buildings.size());
        cluster.buildings.push_back({building, 0});
        cluster.contours.push_back({{{{0, 0}, rim[i], rim[i + 1]}, {}}, -1, building, 10 + building});
    }
    const MadeSurfaces made = surfaces_of(cluster);
    EXPECT_EQ(made.repairs.size(), 3U);
    EXPECT_TRUE(made.left_out.empty());
    EXPECT_EQ(fault_of(made.shell), "");
    EXPECT_EQ(made.shell.size(), 4U);
}

/// Leaves one of those in the way out and names it where there is no room at all; the rest is made.
TEST(NonmanifoldVertices, noRoom) {
    SurfaceCluster cluster;
    const std::vector<FineRing> slivers{{{0, 0}, {2000, -60000}, {2001, -60000}},
                                        {{0, 0}, {-2000, 60001}, {-2001, 60001}}};
    for (const FineRing& ring : slivers) {
        const auto building = static_cast<std::int32_t>(cluster.buildings.size());
        cluster.buildings.push_back({7 + building, 0});
        cluster.contours.push_back({{ring, {}}, -1, building, 10});
    }
    const MadeSurfaces made = surfaces_of(cluster);
    EXPECT_EQ(made.left_out, (std::vector<std::int64_t>{8}));
    ASSERT_EQ(made.shell.size(), 1U);
    EXPECT_EQ(made.shell[0].buildings[0].id, 7);
    EXPECT_EQ(fault_of(made.shell), "");
}

/// The steps in a centimetre, rounded up: 10.24 of a metre, and so on; never fewer than two.
TEST(GapTolerances, followFromTheCell) {
    const auto pinch = [](double across, double down) { return gap_tolerances({across, down}).pinch; };
    EXPECT_EQ(pinch(1, 1), (LatticeDistance{11, 11}));
    EXPECT_EQ(pinch(0.5, 0.5), (LatticeDistance{21, 21}));
    EXPECT_EQ(pinch(0.25, 0.25), (LatticeDistance{41, 41}));
    EXPECT_EQ(pinch(0.1, 0.1), (LatticeDistance{103, 103}));
    EXPECT_EQ(pinch(2.5, 2.5), (LatticeDistance{5, 5}));
    EXPECT_EQ(pinch(30, 30), (LatticeDistance{2, 2}));
    EXPECT_EQ(pinch(0.5, 2), (LatticeDistance{6, 21})) << "rows are farther apart";
    EXPECT_EQ(pinch(0.3048, 0.3048), (LatticeDistance{34, 34})) << "feet";
}

/// 2 mm.
TEST(GapTolerances, ofCornersThatAreOne) {
    EXPECT_EQ(gap_tolerances({1, 1}).corners, (LatticeDistance{3, 3}));
    EXPECT_EQ(gap_tolerances({0.1, 0.1}).corners, (LatticeDistance{21, 21}));
    EXPECT_EQ(gap_tolerances({3, 3}).corners, (LatticeDistance{1, 1})) << "each step is as long";
}

/// Whatever the angle between rows and columns, points on the border of the box are as far away.
TEST(GapTolerances, areLengthsOnTheGround) {
    for (const double angle : {30.0, 90.0, 140.0})
        for (const double down : {0.1, 0.7, 5.0}) {
            const double across = 0.5;
            const double radians = angle * std::numbers::pi / 180;
            const LatticeDistance gap = gap_tolerances({across, down, std::sin(radians)}).pinch;
            double least = 1;
            for (std::int64_t row = -gap.rows; row <= gap.rows; ++row)
                for (std::int64_t col = -gap.cols; col <= gap.cols; ++col)
                    if (gap.parts({0, 0}, {row, col})) {
                        const double x = across * static_cast<double>(col);
                        const double y = down * static_cast<double>(row);
                        least = std::min(least, std::hypot(x + y * std::cos(radians), y * std::sin(radians)) /
                                                    FinePoint::steps);
                    }
            EXPECT_GE(least, 0.01) << angle << " " << down;
        }
}

}  // namespace
}  // namespace d2b::surface

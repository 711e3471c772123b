#include "outline/outline.hpp"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "geometry/geos.hpp"
#include "outline/arc_graph.hpp"
#include "outline/simplify.hpp"
#include "support/outline_checks.hpp"
#include "support/random_grid.hpp"

namespace d2b::outline {
namespace {

using test::one_sided;
using test::planar_area;
using test::trace_grid;
using test::TraceGrid;
using test::unit_grid;

/// A plate of 20 with a tower of 30 along the middle of its upper wall.
TraceGrid plate_with_tower() {
    TraceGrid grid{6, 9, std::vector<double>(54, 0.0), {}};
    for (int row = 1; row <= 4; ++row)
        for (int col = 1; col <= 7; ++col)
            grid.z[static_cast<std::size_t>(row * 9 + col)] = row <= 2 && col >= 3 && col <= 5 ? 30 : 20;
    return grid;
}

TEST(Noding, PutsTheCornersOfOthersIntoAnEdge) {
    Context context;
    const test::ContourSet set = trace_grid(plate_with_tower(), {10, 25}, {}, context);
    ASSERT_EQ(set.contours.size(), 3U);
    const NodedRings noded(set.contours);
    EXPECT_EQ(noded.polygon(1).exterior, (LatticeRing{{1, 1}, {5, 1}, {5, 8}, {1, 8}, {1, 6}, {1, 3}}));
    EXPECT_EQ(noded.polygon(2).exterior, set.contours[2].exterior.corners());
}

TEST(ArcGraph, SharesTheWallOfPlateAndTower) {
    Context context;
    const test::ContourSet set = trace_grid(plate_with_tower(), {10, 25}, {}, context);
    const ArcGraph graph = build_arc_graph(NodedRings(set.contours));
    // The root's ring, the shared wall, the rest of the plate, the rest of the tower.
    EXPECT_EQ(graph.arcs.size(), 4U);
    EXPECT_EQ(graph.outlines[0].exterior.size(), 1U);
    EXPECT_EQ(graph.outlines[1].exterior.size(), 2U);
    EXPECT_EQ(graph.outlines[2].exterior.size(), 2U);
    std::map<std::uint32_t, int> uses;
    for (const ArcGraph::Outline& outline : graph.outlines)
        for (const ArcUse& use : outline.exterior)
            ++uses[use.arc];
    int shared = 0;
    for (const auto& [arc, count] : uses)
        shared += count == 2 ? 1 : 0;
    EXPECT_EQ(shared, 1);
    for (std::size_t i = 0; i < set.contours.size(); ++i)
        EXPECT_EQ(planar_area(fine(graph.polygon(i))), static_cast<double>(set.contours[i].squares()));
}

TEST(Simplify, StraightensAStaircaseWithinTheTolerance) {
    // Steps of one along a diagonal: the far corners are 0.71 off it.
    Arc steps;
    for (int i = 0; i < 10; ++i) {
        steps.push_back({i, i});
        steps.push_back({i, i + 1});
    }
    steps.push_back({10, 10});
    std::vector<Arc> arcs{steps};
    simplify(arcs, 0.75, unit_grid);
    EXPECT_LE(arcs[0].size(), 4U);
    EXPECT_EQ(arcs[0].front(), (LatticePoint{0, 0}));
    EXPECT_EQ(arcs[0].back(), (LatticePoint{10, 10}));
    arcs = {steps};
    simplify(arcs, 0.5, unit_grid);
    EXPECT_EQ(arcs[0], steps);
}

TEST(Simplify, MeasuresInUnitsOfTheCrs) {
    const Arc step{{0, 0}, {0, 1}, {1, 1}, {1, 2}};
    std::vector<Arc> arcs{step};
    simplify(arcs, 0.75, Georeference({0, 10, 0, 0, 0, -10}, TraceMode::cells));
    EXPECT_EQ(arcs[0], step);
    simplify(arcs, 7.5, Georeference({0, 10, 0, 0, 0, -10}, TraceMode::cells));
    EXPECT_LT(arcs[0].size(), step.size());
}

TEST(Simplify, DoesNotJumpOverAnotherOutline) {
    // A bay of depth 3 with a small island in it: without the island the bay goes, with it it stays.
    const Arc shore{{0, 0}, {0, 4}, {3, 4}, {3, 6}, {0, 6}, {0, 10}};
    std::vector<Arc> alone{shore};
    simplify(alone, 4, unit_grid);
    EXPECT_EQ(alone[0].size(), 2U);
    std::vector<Arc> both{shore, {{1, 5}, {2, 5}}};
    simplify(both, 4, unit_grid);
    EXPECT_GT(both[0].size(), 2U);
}

TEST(Simplify, ARingKeepsAnArea) {
    std::vector<Arc> ring{{{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}}};
    simplify(ring, 100, unit_grid);
    EXPECT_EQ(ring[0].size(), 4U);  // a triangle, closed
}

class SimplifiedGrid : public testing::TestWithParam<unsigned> {
  protected:
    void SetUp() override {
        const test::RandomGridCase c = test::random_grid(GetParam(), 26, false);
        mode_ = c.mode;
        set_ = trace_grid(c.grid, c.thresholds, {c.mode, 6}, context_);
        tolerance_ = 0.5 + GetParam() % 6 * 0.5;
        rules_.simplify = tolerance_;
    }
    Context context_;
    TraceMode mode_ = TraceMode::cells;
    test::ContourSet set_;
    double tolerance_ = 1;
    OutlineRules rules_;
};

TEST_P(SimplifiedGrid, StaysValidNestedAndDisjoint) {
    const Outliner outliner(*set_.list, OutlineMethod::simplified, rules_, unit_grid, 1, context_);
    EXPECT_EQ(test::nesting_fault(set_, outliner), "");
}

TEST_P(SimplifiedGrid, StaysWithinTheToleranceBothWays) {
    const Outliner outliner(*set_.list, OutlineMethod::simplified, rules_, unit_grid, 1, context_);
    for (std::size_t i = 0; i < set_.contours.size(); ++i) {
        const FinePolygon drawn = outliner.outline(i);
        const FinePolygon traced = outliner.traced(i);
        EXPECT_LE(one_sided(drawn.exterior, traced.exterior), tolerance_ + 1e-9);
        EXPECT_LE(one_sided(traced.exterior, drawn.exterior), tolerance_ + 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SimplifiedGrid, testing::Range(0U, 120U));

class TracedGrid : public testing::TestWithParam<unsigned> {};

TEST_P(TracedGrid, IsValidAsItIsTraced) {
    const test::RandomGridCase c = test::random_grid(GetParam(), 30);
    Context context;
    const test::ContourSet set =
        trace_grid(c.grid, c.thresholds, {c.mode, static_cast<int>(GetParam() % 9)}, context);
    const Outliner outliner(*set.list, OutlineMethod::traced, {}, unit_grid, 1, context);
    Geos geos;
    for (std::size_t i = 0; i < set.contours.size(); ++i)
        EXPECT_EQ(geos.invalidity({unit_grid.polygon(outliner.outline(i))}), "") << i;
}

INSTANTIATE_TEST_SUITE_P(Seeds, TracedGrid, testing::Range(3000U, 3150U));

class RotatedGrid : public testing::TestWithParam<unsigned> {};

/// On a rotated grid positions are rounded; noded outlines share theirs, so the rest is far below a cell.
TEST_P(RotatedGrid, NestingHoldsToAMillionthOfACell) {
    const test::RandomGridCase c = test::random_grid(GetParam(), 20, false);
    Context context;
    const test::ContourSet set = trace_grid(c.grid, c.thresholds, {c.mode}, context);
    const double angle = 0.37;
    const Georeference rotated({691234.5, 0.5 * std::cos(angle), 0.5 * std::sin(angle), 5334567.5,
                                0.5 * std::sin(angle), -0.5 * std::cos(angle)},
                               c.mode);
    const Outliner outliner(*set.list, OutlineMethod::noded, {}, rotated, 1, context);
    Geos geos;
    for (std::size_t i = 0; i < set.contours.size(); ++i) {
        const WorldPolygon child = rotated.polygon(outliner.outline(i));
        EXPECT_EQ(geos.invalidity({child}), "");
        if (set.contours[i].parent < 0)
            continue;
        const WorldPolygon parent =
            rotated.polygon(outliner.outline(static_cast<std::size_t>(set.contours[i].parent)));
        EXPECT_LT(geos.area_outside(child, parent), 1e-6 * rotated.cell_area());
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RotatedGrid, testing::Range(0U, 60U));

TEST(OutlineMethod, NodesOnlyWhatCanComeApart) {
    const Georeference rotated({0, 0.6, 0.8, 0, 0.8, -0.6}, TraceMode::cells);
    OutlineRules rules;
    rules.walls = Walls::off;
    EXPECT_EQ(choose_outline_method(rules, unit_grid), OutlineMethod::traced);
    EXPECT_EQ(choose_outline_method(rules, rotated), OutlineMethod::noded);
    rules.reprojected = true;
    EXPECT_EQ(choose_outline_method(rules, unit_grid), OutlineMethod::noded);
    rules.simplify = 1;
    EXPECT_EQ(choose_outline_method(rules, unit_grid), OutlineMethod::simplified);
    rules.walls = Walls::right;
    EXPECT_EQ(choose_outline_method(rules, unit_grid), OutlineMethod::regularized);
    EXPECT_EQ(choose_outline_method(rules, rotated), OutlineMethod::regularized);
}

}  // namespace
}  // namespace d2b::outline

#include "surface/make_flow_ready.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/disjoint_sets.hpp"
#include "core/stop_token.hpp"
#include "surface/flow_faults.hpp"
#include "surface/label_contours.hpp"
#include "surface/partition.hpp"
#include "surface/resolve_nonmanifold.hpp"

namespace d2b::surface {
namespace {

/// A step is a centimetre.
FlowLimits limits(double gap, double wall) {
    FlowLimits limits;
    limits.gap = gap;
    limits.wall = wall;
    limits.metric = {{0.01, 0}, {0, -0.01}};
    return limits;
}

/// Corners in centimetres, x and y with y up, counter-clockwise.
FineRing ring(const std::vector<std::pair<int, int>>& corners) {
    FineRing result;
    for (const auto& [x, y] : corners)
        result.push_back({-y, x});
    return result;
}

PartitionContour house(const std::vector<std::pair<int, int>>& corners, std::int32_t building,
                       std::vector<FineRing> holes = {}, std::int32_t parent = -1) {
    return {{ring(corners), std::move(holes)}, parent, building, 10};
}

/// Square metres.
double area(const FinePolygon& polygon) {
    const auto of = [](const FineRing& corners) {
        double twice = 0;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const FinePoint& a = corners[i];
            const FinePoint& b = corners[(i + 1) % corners.size()];
            twice += static_cast<double>(a.col) * static_cast<double>(-b.row) -
                     static_cast<double>(b.col) * static_cast<double>(-a.row);
        }
        return twice / 2 / 10000;
    };
    double sum = of(polygon.exterior);
    for (const FineRing& hole : polygon.interiors)
        sum += of(hole);
    return sum;
}

std::size_t changed(const FlowReady& ready, FlowKind kind) {
    return static_cast<std::size_t>(std::ranges::count_if(
        ready.problems, [&](const FlowProblem& p) { return p.changed && p.kind == kind; }));
}

std::size_t left(const FlowReady& ready) {
    return static_cast<std::size_t>(
        std::ranges::count_if(ready.problems, [](const FlowProblem& p) { return !p.changed; }));
}

TEST(FlowReady, whatIsReadyStays) {
    const std::vector<PartitionContour> town{house({{0, 0}, {2000, 0}, {2000, 1000}, {0, 1000}}, 0),
                                             house({{2100, 0}, {4000, 0}, {4000, 1000}, {2100, 1000}}, 1)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1));
    EXPECT_TRUE(ready.outlines.empty());
    EXPECT_TRUE(ready.problems.empty());
}

TEST(FlowReady, aShortWallGoes) {
    // A step of 20 cm in a wall of 20 m.
    const std::vector<PartitionContour> town{
        house({{0, 0}, {500, 0}, {500, 20}, {2000, 20}, {2000, 3000}, {0, 3000}}, 0)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1));
    ASSERT_EQ(ready.outlines.size(), 1U);
    EXPECT_EQ(ready.outlines[0].exterior.size(), 5U);
    // A triangle of 0.2 x 5 m.
    EXPECT_NEAR(std::abs(area(ready.outlines[0]) - 597), 0.5, 1e-9);
    ASSERT_EQ(ready.problems.size(), 1U);
    EXPECT_EQ(ready.problems[0].kind, FlowKind::wall);
    EXPECT_DOUBLE_EQ(ready.problems[0].before, 0.2);
    EXPECT_EQ(ready.problems[0].after, 0);
    EXPECT_EQ(ready.problems[0].contours, (std::vector<std::int32_t>{0}));
}

/// A house of 10 x 10 m with a step of half a metre in the middle of a wall: moving 5 m of wall would take
/// more than its square metre, so a slanted wall of a metre takes the step's place.
TEST(FlowReady, aShortWallBetweenLongOnesBecomesASlantedOne) {
    const std::vector<PartitionContour> town{
        house({{0, 0}, {500, 0}, {500, 50}, {1000, 50}, {1000, 1000}, {0, 1000}}, 0)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1));
    ASSERT_EQ(ready.outlines.size(), 1U);
    EXPECT_EQ(left(ready), 0U);
    const FineRing& walls = ready.outlines[0].exterior;
    ASSERT_EQ(walls.size(), 6U);
    for (std::size_t i = 0; i < walls.size(); ++i)
        EXPECT_GE(limits(1, 1).metric.distance(walls[i], walls[(i + 1) % walls.size()]), 1);
    // A triangle of half a metre by 1.02 m.
    EXPECT_NEAR(std::abs(area(ready.outlines[0]) - 97.5), 0.255, 0.01);
}

/// Steps of half a metre in a wall of 60 m: each alone is within a hundredth of the house, all are not.
TEST(FlowReady, allChangesTogetherAreWithinTheShare) {
    std::vector<std::pair<int, int>> corners;
    for (int step = 0; step < 12; ++step) {
        corners.emplace_back(500 * step, 50 * (step % 2));
        corners.emplace_back(500 * (step + 1), 50 * (step % 2));
    }
    corners.emplace_back(6000, 400);
    corners.emplace_back(0, 400);
    const std::vector<PartitionContour> town{house(corners, 0)};
    FlowLimits wanted = limits(1, 1);
    wanted.share = 0.1;
    const FlowReady all = make_flow_ready(town, wanted);
    ASSERT_EQ(all.outlines.size(), 1U);
    EXPECT_EQ(left(all), 0U);
    wanted.share = 0.01;
    const FlowReady some = make_flow_ready(town, wanted);
    ASSERT_EQ(some.outlines.size(), 1U);
    EXPECT_GT(changed(some, FlowKind::wall), 2U);
    EXPECT_GT(left(some), 2U);
    EXPECT_EQ(left(some) + changed(some, FlowKind::wall), 11U);
    const double house_m2 = area(town[0].outline);
    EXPECT_NEAR(area(some.outlines[0]), house_m2, 0.01 * house_m2);
}

/// The tip of one stands 40 cm from a long wall of the other, and is cut off.
TEST(FlowReady, aCornerNearAWallIsCutOff) {
    const std::vector<PartitionContour> town{
        house({{0, 0}, {4000, 0}, {4000, 1000}, {0, 1000}}, 0),
        house({{2000, 1040}, {3000, 2040}, {2000, 3040}, {1000, 2040}}, 1)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1));
    ASSERT_EQ(ready.outlines.size(), 2U);
    EXPECT_EQ(left(ready), 0U);
    EXPECT_EQ(changed(ready, FlowKind::gap), 1U);
    EXPECT_EQ(ready.outlines[0].exterior.size(), 4U);
    ASSERT_EQ(ready.outlines[1].exterior.size(), 5U);
    for (const FinePoint& corner : ready.outlines[1].exterior)
        EXPECT_LE(corner.row, -1100);
    EXPECT_NEAR(area(ready.outlines[1]), 200, 2);
}

/// A wall with places on it that are no corners is as long as all of it.
TEST(FlowReady, aShortWallInPiecesIsSeen) {
    const std::vector<PartitionContour> town{
        house({{0, 0}, {2000, 0}, {2000, 2000}, {1400, 2000}, {1420, 2020}, {1450, 2050}, {0, 3500}}, 0)};
    const auto faults = find_faults(PartitionEditor(make_partition(town).plan), town, limits(0, 1));
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_NEAR(faults[0].size, std::hypot(0.5, 0.5), 1e-9);
}

TEST(FlowReady, whatIsFrozenStays) {
    const std::vector<PartitionContour> town{
        house({{0, 0}, {1000, 0}, {1000, 50}, {2000, 50}, {2000, 3000}, {0, 3000}}, 0)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1), {true});
    EXPECT_TRUE(ready.outlines.empty());
    EXPECT_EQ(left(ready), 1U);
}

TEST(FlowReady, onlyWhatIsAskedFor) {
    const std::vector<PartitionContour> step{
        house({{0, 0}, {1000, 0}, {1000, 50}, {2000, 50}, {2000, 3000}, {0, 3000}}, 0)};
    EXPECT_TRUE(make_flow_ready(step, limits(1, 0)).problems.empty());
    EXPECT_TRUE(make_flow_ready(step, limits(1, 0.4)).problems.empty());
    const std::vector<PartitionContour> gap{house({{0, 0}, {4000, 0}, {4000, 4000}, {0, 4000}}, 0),
                                            house({{4050, 0}, {8000, 0}, {8000, 4000}, {4050, 4000}}, 1)};
    EXPECT_TRUE(make_flow_ready(gap, limits(0, 1)).problems.empty());
}

/// Two houses of 40 x 40 m that are 30 cm apart share a wall then.
TEST(FlowReady, aGapIsClosed) {
    const std::vector<PartitionContour> town{house({{0, 0}, {4000, 0}, {4000, 4000}, {0, 4000}}, 0),
                                             house({{4030, 0}, {8000, 0}, {8000, 4000}, {4030, 4000}}, 1)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1));
    ASSERT_EQ(ready.outlines.size(), 2U);
    EXPECT_EQ(left(ready), 0U);
    EXPECT_GE(changed(ready, FlowKind::gap), 1U);
    EXPECT_NEAR(area(ready.outlines[0]) + area(ready.outlines[1]), 40 * 80, 0.01);
    const auto has = [&](const FinePolygon& polygon, FinePoint point) {
        return std::ranges::find(polygon.exterior, point) != polygon.exterior.end();
    };
    // The walls on both sides of the gap are one.
    int shared = 0;
    for (const FinePoint& corner : ready.outlines[0].exterior)
        shared += has(ready.outlines[1], corner) ? 1 : 0;
    EXPECT_EQ(shared, 2);
}

/// A courtyard of half a metre by one in a house of 400 m2 is closed, one of half a metre by 19 would be more
/// than its hundredth.
TEST(FlowReady, aCourtyardThatIsTooLargeIsLeft) {
    const auto with_yard = [](int length) {
        return std::vector<PartitionContour>{
            house({{0, 0}, {2000, 0}, {2000, 2000}, {0, 2000}}, 0,
                  {ring({{100, 1000}, {100, 1050}, {100 + length, 1050}, {100 + length, 1000}})})};
    };
    const FlowReady closed = make_flow_ready(with_yard(100), limits(1, 0.4));
    ASSERT_EQ(closed.outlines.size(), 1U);
    EXPECT_TRUE(closed.outlines[0].interiors.empty());
    EXPECT_EQ(left(closed), 0U);
    const FlowReady kept = make_flow_ready(with_yard(1800), limits(1, 0.4));
    EXPECT_GT(left(kept), 0U);
    EXPECT_EQ(changed(kept, FlowKind::gap), 0U);
}

/// Two squares of 20 x 20 m joined by a part of half a metre that is `length` cm long.
std::vector<std::pair<int, int>> dumbbell(int length) {
    const int far = 2000 + length;
    return {{0, 0},      {2000, 0},       {2000, 975},        {far, 975},
            {far, 0},    {far + 2000, 0}, {far + 2000, 2000}, {far, 2000},
            {far, 1025}, {2000, 1025},    {2000, 2000},       {0, 2000}};
}

/// A part of 0.5 by 3 m becomes 1.02 m wide, which adds 0.52 by 3 m.
TEST(FlowReady, aNarrowPartIsWidened) {
    const std::vector<PartitionContour> town{house(dumbbell(300), 0)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1));
    ASSERT_EQ(ready.outlines.size(), 1U);
    EXPECT_EQ(left(ready), 0U);
    EXPECT_GE(changed(ready, FlowKind::neck), 1U);
    EXPECT_EQ(ready.problems[0].before, 0.5);
    EXPECT_NEAR(area(ready.outlines[0]), 801.5 + 1.56, 0.02);
    EXPECT_EQ(ready.outlines[0].exterior.size(), 12U);
}

TEST(FlowReady, aNarrowPartOfATierIsWidened) {
    const std::vector<PartitionContour> town{
        house({{-500, -500}, {5000, -500}, {5000, 3000}, {-500, 3000}}, 0), house(dumbbell(300), 0, {}, 0)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1));
    ASSERT_EQ(ready.outlines.size(), 2U);
    EXPECT_EQ(left(ready), 0U);
    EXPECT_NEAR(area(ready.outlines[1]), 801.5 + 1.56, 0.02);
    EXPECT_NEAR(area(ready.outlines[0]), 55 * 35, 1e-9);
}

/// Widening 60 m by half a metre at either end would be more than a hundredth of 830 m2.
TEST(FlowReady, aNarrowPartThatIsTooLongIsLeft) {
    const std::vector<PartitionContour> town{house(dumbbell(6000), 0)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1));
    EXPECT_TRUE(ready.outlines.empty());
    ASSERT_FALSE(ready.problems.empty());
    for (const FlowProblem& problem : ready.problems) {
        EXPECT_EQ(problem.kind, FlowKind::neck);
        EXPECT_FALSE(problem.changed);
        EXPECT_EQ(problem.after, 0.5);
        EXPECT_EQ(problem.contours, (std::vector<std::int32_t>{0}));
    }
}

/// The tip of a notch is 60 cm from the wall behind it and 105 cm from another house, so that the wall
/// yields: it gets a corner 42 cm farther out.
TEST(FlowReady, theWallAcrossANotchYields) {
    const std::vector<PartitionContour> town{house({{-9000, 0},
                                                    {9000, 0},
                                                    {9000, 6000},
                                                    {3000, 6000},
                                                    {3000, 950},
                                                    {0, 60},
                                                    {-3000, 950},
                                                    {-3000, 6000},
                                                    {-9000, 6000}},
                                                   0),
                                             house({{0, 165}, {1600, 6000}, {-1600, 6000}}, 1)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1));
    ASSERT_EQ(ready.outlines.size(), 2U);
    EXPECT_EQ(left(ready), 0U);
    EXPECT_EQ(changed(ready, FlowKind::neck), 1U);
    const FineRing& walls = ready.outlines[0].exterior;
    EXPECT_EQ(walls.size(), 10U);
    EXPECT_NE(std::ranges::find(walls, FinePoint{42, 0}), walls.end());
}

/// The corner of one is cut back from the other, by a metre at least.
TEST(FlowReady, housesThatTouchInACorner) {
    const std::vector<PartitionContour> town{
        house({{0, 0}, {2000, 0}, {2000, 2000}, {0, 2000}}, 0),
        house({{2000, 2000}, {4000, 2000}, {4000, 4000}, {2000, 4000}}, 1)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1));
    ASSERT_EQ(ready.outlines.size(), 2U);
    EXPECT_EQ(left(ready), 0U);
    ASSERT_EQ(changed(ready, FlowKind::touch), 1U);
    for (const FinePoint& corner : ready.outlines[0].exterior)
        EXPECT_EQ(std::ranges::count(ready.outlines[1].exterior, corner), 0);
    // The part cut off is a corner: the walls stand beyond three metres.
    EXPECT_NEAR(area(ready.outlines[0]) + area(ready.outlines[1]), 800, 4);
}

/// Of 36 m2 not more than 0.36 are cut off, so that the gap stays narrower than it should be, and is named.
TEST(FlowReady, smallHousesThatTouchInACorner) {
    const std::vector<PartitionContour> town{house({{0, 0}, {600, 0}, {600, 600}, {0, 600}}, 0),
                                             house({{600, 600}, {1200, 600}, {1200, 1200}, {600, 1200}}, 1)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1));
    ASSERT_EQ(ready.outlines.size(), 2U);
    for (const FinePolygon& outline : ready.outlines) {
        EXPECT_LE(area(outline), 36);
        EXPECT_GE(area(outline), 36 * 0.99);
    }
    for (const FinePoint& corner : ready.outlines[0].exterior)
        EXPECT_EQ(std::ranges::count(ready.outlines[1].exterior, corner), 0);
    ASSERT_GE(changed(ready, FlowKind::touch), 1U);
    const auto is_narrow = [](const FlowProblem& problem) {
        return problem.kind == FlowKind::gap && !problem.changed && problem.after > 0.4 && problem.after < 1;
    };
    EXPECT_TRUE(std::ranges::any_of(ready.problems, is_narrow));
}

/// A spike of 5 degrees that stands 10 m out of a house.
TEST(FlowReady, aSharpCornerIsCutOff) {
    const std::vector<PartitionContour> town{
        house({{0, 0}, {3000, 0}, {3000, 1000}, {4000, 1044}, {3000, 1087}, {3000, 3000}, {0, 3000}}, 0)};
    const FlowReady ready = make_flow_ready(town, limits(0.5, 0.5));
    ASSERT_EQ(ready.outlines.size(), 1U);
    EXPECT_EQ(left(ready), 0U);
    EXPECT_EQ(changed(ready, FlowKind::angle), 1U);
    EXPECT_NEAR(area(ready.outlines[0]), 900, 5);
}

/// A tier keeps to its footprint when a wall of both moves.
TEST(FlowReady, tiersNest) {
    const std::vector<PartitionContour> town{
        house({{0, 0}, {1000, 0}, {1000, 50}, {2000, 50}, {2000, 3000}, {0, 3000}}, 0),
        house({{500, 0}, {1000, 0}, {1000, 50}, {1500, 50}, {1500, 500}, {500, 500}}, 0, {}, 0)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1));
    ASSERT_EQ(ready.outlines.size(), 2U);
    EXPECT_EQ(left(ready), 0U);
}

TEST(FlowReady, outlinesThatCrossAreLeft) {
    const std::vector<PartitionContour> town{
        house({{0, 0}, {2000, 0}, {2000, 2000}, {0, 2000}}, 0),
        house({{1000, 1000}, {3000, 1000}, {3000, 3000}, {1000, 3000}}, 1)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1));
    EXPECT_TRUE(ready.outlines.empty());
    ASSERT_EQ(ready.problems.size(), 1U);
    EXPECT_EQ(ready.problems[0].kind, FlowKind::crossing);
    EXPECT_FALSE(ready.problems[0].changed);
}

/// Areas of the blocks of touching contours of the lowest level, in cells.
std::map<std::uint32_t, double> block_areas(const SurfaceCluster& cluster,
                                            std::span<const FinePolygon> outlines) {
    DisjointSets blocks(static_cast<std::uint32_t>(cluster.contours.size()));
    const auto root = [&](std::int32_t contour) {
        while (cluster.contours[static_cast<std::size_t>(contour)].parent >= 0)
            contour = cluster.contours[static_cast<std::size_t>(contour)].parent;
        return static_cast<std::uint32_t>(contour);
    };
    for (const PartitionEdge& edge : make_partition(cluster.contours).plan.edges)
        if (edge.left != open_ground && edge.right != open_ground)
            blocks.join(root(edge.left), root(edge.right));
    std::map<std::uint32_t, double> areas;
    for (std::uint32_t c = 0; c < cluster.contours.size(); ++c)
        if (cluster.contours[c].parent < 0)
            areas[blocks.find(c)] += area(outlines[c]) * 10000 / (1024 * 1024);
    return areas;
}

/// Taking corners apart by a centimetre is allowed beyond it: ten cells of wall move so far.
void expect_little_changed(const SurfaceCluster& cluster, const FlowReady& ready, double cell_m,
                           const std::string& what) {
    std::vector<FinePolygon> before;
    for (const PartitionContour& contour : cluster.contours)
        before.push_back(contour.outline);
    const auto after = block_areas(cluster, ready.outlines);
    for (const auto& [block, cells] : block_areas(cluster, before))
        ASSERT_NEAR(after.at(block), cells, 0.0101 * cells + 10 * 0.01 / cell_m) << what;
}

/// Whatever the town: outlines are a partition, nothing touches in a point, and all shortfalls are named.
void expect_ready(const SurfaceCluster& cluster, double cell_m, const std::string& what) {
    FlowLimits wanted;
    wanted.gap = wanted.wall = 1;
    wanted.metric = {{cell_m / 1024, 0}, {0, -cell_m / 1024}};
    const FlowReady ready = make_flow_ready(cluster.contours, wanted);
    std::vector<PartitionContour> contours = cluster.contours;
    if (!ready.outlines.empty()) {
        ASSERT_EQ(ready.outlines.size(), contours.size()) << what;
        for (std::size_t i = 0; i < contours.size(); ++i)
            contours[i].outline = ready.outlines[i];
        expect_little_changed(cluster, ready, cell_m, what);
    }
    PartitionResult partition = make_partition(contours);
    ASSERT_TRUE(partition.conflicting.empty()) << what;
    const auto faults = find_faults(PartitionEditor(partition.plan), contours, wanted);
    if (!ready.outlines.empty()) {
        ASSERT_EQ(faults.size(), left(ready)) << what;
        for (PartitionContour& contour : contours)
            contour.top = contour.parent < 0 ? 1 : contours[static_cast<std::size_t>(contour.parent)].top + 1;
        ASSERT_TRUE(resolve_nonmanifold_vertices(partition.plan, contours).repairs.empty()) << what;
    } else {
        ASSERT_LE(faults.size(), left(ready)) << what;
    }
}

std::string random_rows(std::mt19937& random, const std::string& letters, LetterGrid& grid) {
    std::string text = "\n";
    const auto size = [&] { return 2 + random() % 9; };
    const auto rows = size();
    const auto cols = size();
    for (std::size_t row = 0; row < rows; ++row) {
        std::string& line = grid.rows.emplace_back();
        for (std::size_t col = 0; col < cols; ++col)
            line += letters[random() % letters.size()];
        text += line + "|\n";
    }
    return text;
}

TEST(FlowReady, randomTowns) {
    std::mt19937 random(16);
    for (int i = 0; i < 40; ++i)
        for (const double cell : {0.4, 0.9, 3.0}) {
            LetterGrid blocks;
            const std::string text = random_rows(random, i % 2 == 0 ? "aab " : "abc   ", blocks);
            expect_ready(blocks_of(blocks, {10, 20, 30}), cell, text);
            LetterGrid stacks;
            const std::string tiers = random_rows(random, i % 2 == 0 ? "0123" : "001122", stacks);
            expect_ready(stacks_of(stacks), cell, tiers);
        }
}

/// Looking again near changes finds the same as looking at everything.
TEST(FlowFaults, followChanges) {
    std::mt19937 random(36);
    const StopToken stop;
    for (int i = 0; i < 60; ++i) {
        LetterGrid grid;
        const std::string text = random_rows(random, i % 2 == 0 ? "aab " : "ab  ", grid);
        const SurfaceCluster cluster = blocks_of(grid, {10, 20});
        FlowLimits wanted;
        wanted.gap = i % 3 == 0 ? 1 : 2.5;
        wanted.wall = i % 3 == 1 ? 0 : 1.5;
        wanted.metric = {{0.7 / 1024, 0}, {0, -0.7 / 1024}};
        PartitionEditor plan(make_partition(cluster.contours).plan);
        FlowFaults known(plan, cluster.contours, wanted, stop);
        for (int step = 0; step < 12 && !plan.edges().empty(); ++step) {
            const auto edge = static_cast<std::uint32_t>(random() % plan.edges().size());
            if (!plan.is_edge(edge))
                continue;
            const PartitionEdge e = plan.edges()[edge];
            const FinePoint a = plan.at(e.from);
            const FinePoint b = plan.at(e.to);
            if (step % 3 == 0)
                static_cast<void>(
                    plan.split(edge, {a.row + (b.row - a.row) / 3, a.col + (b.col - a.col) / 3}));
            else
                static_cast<void>(plan.merge(e.from, e.to));
            known.update(plan.take_changes());
            const FlowFaults anew(plan, cluster.contours, wanted, stop);
            const auto same = [](const KnownFault& one, const KnownFault& other) {
                return one.found_at == other.found_at && one.fault.kind == other.fault.kind &&
                       one.fault.node == other.fault.node && one.fault.one == other.fault.one &&
                       one.fault.size == other.fault.size && one.fault.place == other.fault.place;
            };
            ASSERT_TRUE(std::ranges::equal(known.walls(), anew.walls(), same)) << text << step;
            ASSERT_TRUE(std::ranges::equal(known.corners(), anew.corners(), same)) << text << step;
        }
    }
}

/// A block of 40 x 40 cells, as ragged as can be: an end is asked for in each of its parts.
TEST(FlowReady, endsWhereThatIsAskedFor) {
    std::mt19937 random(5);
    LetterGrid grid;
    for (int row = 0; row < 40; ++row) {
        std::string& line = grid.rows.emplace_back();
        for (int col = 0; col < 40; ++col)
            line += row % 8 == 0 || random() % 2 == 0 ? 'a' : ' ';
    }
    const SurfaceCluster cluster = blocks_of(grid, {10});
    FlowLimits wanted;
    wanted.gap = wanted.wall = 2;
    wanted.metric = {{0.2 / 1024, 0}, {0, -0.2 / 1024}};
    int asked = 0;
    static_cast<void>(make_flow_ready(cluster.contours, wanted, {}, StopToken([&] {
                                          ++asked;
                                          return false;
                                      })));
    ASSERT_GT(asked, 1000);
    for (const int share : {1, 3, 5, 7, 9}) {
        int left = asked * share / 10;
        EXPECT_THROW(static_cast<void>(make_flow_ready(cluster.contours, wanted, {},
                                                       StopToken([&] { return --left < 0; }))),
                     Cancelled);
        EXPECT_EQ(left, -1);
    }
}

/// Half a millimetre is straight, two millimetres are not, and where another wall begins the corner stays.
/// Many corners that go do not bend a wall by more.
TEST(FlowReady, cornersInStraightWallsGo) {
    FlowMetric metric{{0.0001, 0}, {0, -0.0001}};
    const std::vector<PartitionContour> town{
        house(
            {{0, 0}, {1000, 0}, {20000, -5}, {30000, 0}, {35000, 20}, {40000, 0}, {40000, 40000}, {0, 40000}},
            0),
        house({{0, 40000}, {10000, 40000}, {10000, 60000}, {0, 60000}}, 1)};
    PartitionEditor plan(make_partition(town).plan);
    const std::size_t before = plan.plan().nodes.size();
    take_needless_corners(plan, metric, [](std::uint32_t) { return true; });
    EXPECT_EQ(plan.plan().nodes.size(),
              before - 2);  // two of the wall, and none of the corner of the other house
    // A bow of a hundred corners that rises by a metre.
    std::vector<std::pair<int, int>> bow{{100000, 100000}, {0, 100000}};
    for (int i = 0; i <= 100; ++i)
        bow.emplace_back(i * 1000, -4 * i * (100 - i));
    const std::vector<PartitionContour> round{house(bow, 0)};
    PartitionEditor curved(make_partition(round).plan);
    take_needless_corners(curved, metric, [](std::uint32_t) { return true; });
    const PlanarPartition left = curved.plan();
    for (const auto& [x, y] : bow) {
        double least = 1e9;
        for (const PartitionEdge& edge : left.edges)
            least = std::min(least, metric.distance_to({-y, x}, left.nodes[edge.from], left.nodes[edge.to]));
        EXPECT_LE(least, 0.0011) << x;
    }
    PartitionEditor kept(make_partition(town).plan);
    take_needless_corners(kept, metric, [](std::uint32_t) { return false; });
    EXPECT_EQ(kept.plan().nodes.size(), before);
}

/// A mend that comes to nothing leaves no corner behind: a block may change by less than closing its gap
/// takes.
TEST(FlowReady, whatCannotBeMendedGetsNoCorners) {
    const std::vector<PartitionContour> town{
        house({{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}}, 0),
        house({{1050, -20}, {2000, -20}, {2000, 1040}, {1050, 1040}}, 1)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1));
    EXPECT_GT(left(ready), 0U);
    if (!ready.outlines.empty()) {
        EXPECT_EQ(ready.outlines[0].exterior.size() + ready.outlines[1].exterior.size(), 8U);
    }
}

/// A house of 30 x 40 m with a step of 20 cm in a wall, and a hut of 60 x 60 cm at another wall. The hut has
/// no wall that is long enough, so it would be merged into nothing; it stays, and the step goes all the same.
TEST(FlowReady, aContourThatWouldBreakStays) {
    const std::vector<std::pair<int, int>> hut{{3000, 1000}, {3060, 1000}, {3060, 1060}, {3000, 1060}};
    const std::vector<PartitionContour> town{
        house({{0, 0}, {500, 0}, {500, 20}, {3000, 20}, {3000, 1000}, {3000, 1060}, {3000, 4000}, {0, 4000}},
              0),
        house(hut, 1)};
    const FlowReady ready = make_flow_ready(town, limits(1, 1));
    ASSERT_EQ(ready.outlines.size(), 2U);
    FineRing walls = ready.outlines[1].exterior;
    FineRing before = ring(hut);
    std::ranges::sort(walls);
    std::ranges::sort(before);
    EXPECT_EQ(walls, before);
    EXPECT_EQ(changed(ready, FlowKind::wall), 1U);
    // A triangle of 0.2 x 5 m of 30 x 40 m less 0.2 x 25 m.
    EXPECT_NEAR(std::abs(area(ready.outlines[0]) - 1195), 0.5, 1e-9);
    // Each wall of the hut is left and named.
    EXPECT_EQ(std::ranges::count_if(ready.problems,
                                    [](const FlowProblem& p) {
                                        return !p.changed && p.kind == FlowKind::wall &&
                                               std::abs(p.after - 0.6) < 1e-9;
                                    }),
              4);
}

/// Towers of cells of 40 cm of which one breaks when all others are mended already.
const LetterGrid breaks_late{{"20002", "33112", "00333", "32110", "32322"}};

/// Adds as many houses of 16 x 16 m, each with a step of 40 cm, in rows of ten, south of that.
LetterGrid with_houses(LetterGrid grid, int count) {
    for (int first = 0; first < count; first += 10) {
        grid.rows.resize(grid.rows.size() + 5);
        for (int row = 0; row < 40; ++row) {
            std::string& line = grid.rows.emplace_back();
            for (int i = first; i < std::min(count, first + 10); ++i)
                line += (row == 0 ? std::string(20, '1') + std::string(20, ' ') : std::string(40, '1')) +
                        std::string(5, ' ');
        }
    }
    return grid;
}

/// How often making a cluster ready asks whether to stop, which measures its work.
int work_of(const LetterGrid& grid) {
    FlowLimits wanted;
    wanted.gap = wanted.wall = 1;
    wanted.metric = {{0.4 / 1024, 0}, {0, -0.4 / 1024}};
    int asked = 0;
    const FlowReady ready = make_flow_ready(stacks_of(grid).contours, wanted, {}, StopToken([&] {
                                                ++asked;
                                                return false;
                                            }));
    EXPECT_FALSE(ready.outlines.empty());
    return asked;
}

/// Mended places in a cluster are not mended again because one contour breaks later.
TEST(FlowReady, aContourThatBreaksLateRepeatsLittle) {
    const int alone = work_of(with_houses({}, 60));
    const int with_towers = work_of(with_houses(breaks_late, 60)) - work_of(breaks_late);
    EXPECT_GT(alone, 60);
    EXPECT_LT(with_towers, 1.25 * alone);
}

}  // namespace
}  // namespace d2b::surface

#include "dem2buildings_mesh/refine_plan.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace d2b::test {
namespace {

using namespace mesh;

std::array<Position, 3> corners(const PlanMesh& mesh, const PlanTriangle& triangle) {
    return {mesh.nodes[triangle.nodes[0]], mesh.nodes[triangle.nodes[1]], mesh.nodes[triangle.nodes[2]]};
}

/// Counter-clockwise.
double area(const std::array<Position, 3>& at) {
    return ((at[1].x - at[0].x) * (at[2].y - at[0].y) - (at[1].y - at[0].y) * (at[2].x - at[0].x)) / 2;
}

double area_of(const PlanMesh& mesh, std::int32_t region) {
    double sum = 0;
    for (const PlanTriangle& triangle : mesh.triangles)
        if (triangle.region == region)
            sum += area(corners(mesh, triangle));
    return sum;
}

double smallest(const PlanMesh& mesh) {
    double angle = 180;
    for (const PlanTriangle& triangle : mesh.triangles)
        angle = std::min(angle, smallest_angle(corners(mesh, triangle)).degrees);
    return angle;
}

/// 100 by 10 with a strip of 100 by 1 on its north, in regions 0 and 1.
PlanDrawing two_strips() {
    PlanDrawing drawing;
    drawing.nodes = {{0, 0}, {100, 0}, {100, 10}, {0, 10}, {100, 11}, {0, 11}};
    drawing.edges = {{0, 1, 0, -1}, {1, 2, 0, -1}, {2, 3, 0, 1}, {3, 0, 0, -1},
                     {2, 4, 1, -1}, {4, 5, 1, -1}, {5, 3, 1, -1}};
    return drawing;
}

TEST(RefinePlan, keepsAnglesAndRegions) {
    for (const double angle : {0.0, 20.7, 30.0}) {
        const PlanMesh mesh = refine_plan(two_strips(), {.min_angle = angle});
        EXPECT_GE(smallest(mesh), angle);
        EXPECT_NEAR(area_of(mesh, 0), 1000, 1e-9);
        EXPECT_NEAR(area_of(mesh, 1), 100, 1e-9);
        EXPECT_TRUE(std::ranges::all_of(
            mesh.triangles, [&](const PlanTriangle& triangle) { return area(corners(mesh, triangle)) > 0; }));
    }
}

TEST(RefinePlan, addsNothingThatIsNotAskedFor) {
    EXPECT_EQ(refine_plan(two_strips(), {.min_angle = 0}).nodes.size(), 6U);
}

TEST(RefinePlan, leavesAnglesOfTheInput) {
    // Ten degrees at the tip, which nothing can change.
    PlanDrawing drawing;
    drawing.nodes = {{0, 0}, {100, 0}, {100, 100 * std::tan(10 * 3.14159265358979 / 180)}};
    drawing.edges = {{0, 1, 0, -1}, {1, 2, 0, -1}, {2, 0, 0, -1}};
    const PlanMesh mesh = refine_plan(drawing, {});
    EXPECT_NEAR(smallest(mesh), 10, 1e-6);
    EXPECT_EQ(std::ranges::count_if(mesh.triangles,
                                    [&](const PlanTriangle& triangle) {
                                        return smallest_angle(corners(mesh, triangle)).degrees < sure_angle;
                                    }),
              1);
}

/// By the area where edges are short, else by the length of the edges that are drawn.
TEST(RefinePlan, tellsHowManyPointsShortEdgesTake) {
    const double area = 1100;
    const double length = 100 * 3 + 10 * 2 + 1 * 2;
    EXPECT_NEAR(fewest_points(two_strips(), 0.1), area / (std::sqrt(3) / 2) / 0.01, 1e-6);
    EXPECT_NEAR(fewest_points(two_strips(), 100), length / 100, 1e-9);
    EXPECT_LE(fewest_points(two_strips(), 4),
              static_cast<double>(refine_plan(two_strips(), {.max_edge = 4}).nodes.size()));
}

TEST(RefinePlan, keepsEdgesShort) {
    const PlanMesh mesh = refine_plan(two_strips(), {.min_angle = 20.7, .max_edge = 4});
    double longest = 0;
    for (const PlanTriangle& triangle : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const Position a = mesh.nodes[triangle.nodes[i]];
            const Position b = mesh.nodes[triangle.nodes[(i + 1) % 3]];
            longest = std::max(longest, std::hypot(a.x - b.x, a.y - b.y));
        }
    EXPECT_LE(longest, 4);
    EXPECT_GT(longest, 1);
}

TEST(RefinePlan, asksWhatElseIsTooCoarse) {
    RefineRules rules;
    rules.too_coarse = [](const std::array<Position, 3>& at) { return area(at) > 2; };
    const PlanMesh mesh = refine_plan(two_strips(), rules);
    for (const PlanTriangle& triangle : mesh.triangles)
        EXPECT_LE(area(corners(mesh, triangle)), 2);
}

TEST(RefinePlan, leavesCourtyardsOpenUnlessThereIsGround) {
    PlanDrawing drawing;
    drawing.nodes = {{0, 0},   {30, 0},  {30, 30}, {0, 30},  {10, 10}, {20, 10},
                     {20, 20}, {10, 20}, {-9, -9}, {39, -9}, {39, 39}, {-9, 39}};
    drawing.edges = {{0, 1, 0, -1}, {1, 2, 0, -1}, {2, 3, 0, -1}, {3, 0, 0, -1},
                     {4, 5, -1, 0}, {5, 6, -1, 0}, {6, 7, -1, 0}, {7, 4, -1, 0}};
    EXPECT_NEAR(area_of(refine_plan(drawing, {}), 0), 800, 1e-9);
    EXPECT_EQ(area_of(refine_plan(drawing, {}), open_ground), 0);
    drawing.with_ground = true;
    for (std::uint32_t i = 8; i < 12; ++i)
        drawing.edges.push_back({i, i == 11 ? 8 : i + 1, open_ground, beyond});
    const PlanMesh mesh = refine_plan(drawing, {});
    EXPECT_NEAR(area_of(mesh, 0), 800, 1e-9);
    EXPECT_NEAR(area_of(mesh, open_ground), 48 * 48 - 800, 1e-9);
}

TEST(RefinePlan, refusesARegionWithinAnother) {
    PlanDrawing drawing = two_strips();
    drawing.nodes.insert(drawing.nodes.end(), {{10, 3}, {20, 3}, {20, 8}});
    drawing.edges.insert(drawing.edges.end(), {{6, 7, 1, -1}, {7, 8, 1, -1}, {8, 6, 1, -1}});
    EXPECT_THROW(static_cast<void>(refine_plan(drawing, {})), PlanFault);
    // Edges that cross.
    drawing = two_strips();
    drawing.edges.push_back({0, 4, 0, 1});
    EXPECT_THROW(static_cast<void>(refine_plan(drawing, {})), PlanFault);
}

}  // namespace
}  // namespace d2b::test

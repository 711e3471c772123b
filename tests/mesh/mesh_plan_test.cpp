#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings_mesh/city_plan.hpp"
#include "dem2buildings_mesh/read_city.hpp"
#include "dem2buildings_mesh/refine_plan.hpp"
#include "dem2buildings_mesh/stand_up.hpp"
#include "dem2buildings_mesh/terrain.hpp"
#include "mesh/made_city.hpp"
#include "support/error_of.hpp"

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

/// Estimates by the area where edges are short, else by the length of the edges that are drawn.
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
    EXPECT_EQ(area_of(refine_plan(drawing, {}), surface::open_ground), 0);
    drawing.with_ground = true;
    for (std::uint32_t i = 8; i < 12; ++i)
        drawing.edges.push_back({i, i == 11 ? 8 : i + 1, surface::open_ground, beyond});
    const PlanMesh mesh = refine_plan(drawing, {});
    EXPECT_NEAR(area_of(mesh, 0), 800, 1e-9);
    EXPECT_NEAR(area_of(mesh, surface::open_ground), 48 * 48 - 800, 1e-9);
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

mesh::CityPlan plan_of(const std::vector<MadeBlock>& blocks) {
    return mesh::make_city_plan(mesh::parse_city(made_city(blocks).dump(), "x"), {});
}

std::string said_of(const std::vector<MadeBlock>& blocks) {
    return error_of<InputError>([&] { static_cast<void>(plan_of(blocks)); });
}

TEST(CityPlan, cutsWallsWhereNeighboursHaveCorners) {
    // The right one begins halfway up the wall of the left one: a node more than their eight corners have.
    const mesh::CityPlan plan =
        plan_of({made_box("a", 0, 0, 80, 80, 9000), made_box("b", 80, 40, 160, 80, 7000)});
    EXPECT_EQ(plan.plan.nodes.size(), 7U);
    EXPECT_EQ(plan.plan.edges.size(), 8U);
    EXPECT_EQ(plan.regions[0].top, 9000);
    EXPECT_EQ(plan.regions[1].building, 1);
    EXPECT_TRUE(plan.pinches.empty());
}

TEST(CityPlan, putsTouchingBuildingsOnOneLevel) {
    const mesh::CityPlan plan =
        plan_of({made_box("a", 0, 0, 80, 80, 9000, 500), made_box("b", 80, 0, 160, 80, 7000, -300),
                 made_box("c", 800, 0, 880, 80, 7000, 900)});
    EXPECT_EQ(plan.regions[0].base, -300);
    EXPECT_EQ(plan.regions[1].base, -300);
    EXPECT_EQ(plan.regions[2].base, 900);
}

TEST(CityPlan, takesPinchesApart) {
    const mesh::CityPlan plan =
        plan_of({made_box("a", 0, 0, 80, 80, 9000), made_box("b", 80, 80, 160, 160, 7000)});
    ASSERT_EQ(plan.pinches.size(), 1U);
    EXPECT_EQ(plan.pinches[0], (FinePoint{-80, 80}));
}

TEST(CityPlan, refusesTwoRoofsOverOnePlace) {
    EXPECT_EQ(said_of({made_box("a", 0, 0, 80, 80, 9000), made_box("b", 40, 40, 160, 160, 7000)}),
              "'x' has two roofs over one place, or roofs that cross, near 500002.500 5800002.500 (b); the "
              "file is damaged.");
    EXPECT_NE(said_of({made_box("a", 0, 0, 80, 80, 9000), made_box("b", 0, 0, 80, 80, 7000)}), "(no error)");
}

TEST(CityPlan, refusesARoofBelowTheGroundOfItsBlock) {
    EXPECT_EQ(said_of({made_box("a", 0, 0, 80, 80, -5, 0)}),
              "'x' has a roof of a that is not above the ground of its block; the file is damaged.");
}

/// A unit of the plane is a metre, a step of height a millimetre.
PlanFrame metres() {
    PlanFrame frame;
    frame.surface.scale = {1.0 / static_cast<double>(parts_a_step), 1.0 / static_cast<double>(parts_a_step),
                           0.001};
    return frame;
}

/// A square in two triangles.
PlanMesh square(double side, std::int32_t region) {
    return {{{0, 0}, {0, side}, {side, 0}, {side, side}}, {{{0, 2, 3}, region}, {{0, 3, 1}, region}}};
}

TEST(StandUp, dividesWallsUntilTheirEdgesAreShort) {
    const Shell shell = stand_up(square(1, 0), {{{0, 6000, 0}}, {}, 0}, metres(), 1.5);
    // Four columns of six metres, in parts of 1.06 m at most.
    EXPECT_EQ(shell.points.size(), 4U * 7);
}

/// An edge of the plan that is longer cannot be had shorter by corners above it, and the rounds end.
TEST(StandUp, namesAWallThatStaysTooLong) {
    try {
        static_cast<void>(stand_up(square(10, 0), {{{0, 1000, 0}}, {}, 0}, metres(), 5));
        FAIL() << "no wall is named";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(),
                     "Edges of a wall at 0.000 0.000 stay longer than -max_edge; give a larger one.");
    }
}

/// A square of 3 x 3 cells, of which one lies three metres above the others.
TEST(MeasureTerrain, listsCellsThatAreFartherOff) {
    std::vector<double> elevations(9, 0);
    elevations[5] = 3000;  // second row, third column
    const GroundGrid grid(3, 3, elevations, {0, 1, 0, 3, 0, -1});
    MeshRequest request;
    MeshReport report;
    measure_terrain(square(3, surface::open_ground), {{}, {0, 0, 0, 0}, 0}, grid, request, metres(), report);
    EXPECT_EQ(report.ground_error, 3);
    ASSERT_EQ(report.missed.size(), 1U);
    EXPECT_DOUBLE_EQ(report.missed[0].at.x, 2.5);
    EXPECT_DOUBLE_EQ(report.missed[0].at.y, 1.5);
    EXPECT_EQ(report.missed[0].figure, 3);
    request.ground_error = 3;
    MeshReport wide;
    measure_terrain(square(3, surface::open_ground), {{}, {0, 0, 0, 0}, 0}, grid, request, metres(), wide);
    EXPECT_TRUE(wide.missed.empty());
}

}  // namespace
}  // namespace d2b::test

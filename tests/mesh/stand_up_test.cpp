#include "dem2buildings_mesh/stand_up.hpp"

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings_mesh/terrain.hpp"

namespace d2b::test {
namespace {

using namespace mesh;

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
    measure_terrain(square(3, open_ground), {{}, {0, 0, 0, 0}, 0}, grid, request, metres(), report);
    EXPECT_EQ(report.ground_error, 3);
    ASSERT_EQ(report.missed.size(), 1U);
    EXPECT_DOUBLE_EQ(report.missed[0].at.x, 2.5);
    EXPECT_DOUBLE_EQ(report.missed[0].at.y, 1.5);
    EXPECT_EQ(report.missed[0].figure, 3);
    request.ground_error = 3;
    MeshReport wide;
    measure_terrain(square(3, open_ground), {{}, {0, 0, 0, 0}, 0}, grid, request, metres(), wide);
    EXPECT_TRUE(wide.missed.empty());
}

}  // namespace
}  // namespace d2b::test

#include "dem2buildings_mesh/check_shell.hpp"

#include <gtest/gtest.h>

namespace d2b::test {
namespace {

using namespace mesh;

/// Four points, four triangles; all count as walls, which need not face up.
void add_tetrahedron(Shell& shell, const std::array<std::uint32_t, 4>& p) {
    for (const auto& points : {std::array{p[0], p[2], p[1]}, std::array{p[0], p[1], p[3]},
                               std::array{p[1], p[2], p[3]}, std::array{p[2], p[0], p[3]}})
        shell.triangles.push_back({ShellPart::wall, 0, points});
}

Shell tetrahedron() {
    Shell shell{{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}}, {}};
    add_tetrahedron(shell, {0, 1, 2, 3});
    return shell;
}

std::string fault(const Shell& shell) {
    const auto found = fault_of(shell);
    return found ? found->what : "";
}

TEST(CheckShell, takesAClosedOne) {
    EXPECT_EQ(fault(tetrahedron()), "");
}

TEST(CheckShell, findsHoles) {
    Shell shell = tetrahedron();
    shell.triangles.pop_back();
    EXPECT_EQ(fault(shell), "is open");
}

TEST(CheckShell, findsEdgesOfFourTriangles) {
    Shell shell = tetrahedron();
    shell.points.insert(shell.points.end(), {{20, 0, 0}, {0, -9, 5}});
    add_tetrahedron(shell, {0, 3, 4, 5});
    EXPECT_EQ(fault(shell), "touches itself in an edge");
}

TEST(CheckShell, findsPointsWithTwoFans) {
    Shell shell = tetrahedron();
    shell.points.insert(shell.points.end(), {{-9, 0, 0}, {-9, -9, 0}, {-9, 0, -9}});
    add_tetrahedron(shell, {0, 4, 5, 6});
    EXPECT_EQ(fault(shell), "touches itself in a point");
}

TEST(CheckShell, findsFlatRoofsAndEqualPoints) {
    Shell shell = tetrahedron();
    shell.triangles[1].part = ShellPart::roof;  // upright
    EXPECT_EQ(fault(shell), "has corners nearer to each other than its grid");
    shell = tetrahedron();
    shell.points[3] = shell.points[0];
    EXPECT_EQ(fault(shell), "has corners nearer to each other than its grid");
}

TEST(CheckShell, findsWhatSinglePrecisionMerges) {
    SurfaceFrame frame;
    frame.scale = {0.001, 0.001, 0.001};
    Shell shell{{{0, 0, 0}, {1, 0, 0}}, {}};
    EXPECT_FALSE(merged_in_single(shell, frame));
    frame.origin = {-100000, 0, 0};  // single precision has steps of 8 mm there
    EXPECT_TRUE(merged_in_single(shell, frame));
}

}  // namespace
}  // namespace d2b::test

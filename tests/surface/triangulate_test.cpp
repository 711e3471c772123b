#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "surface/faces.hpp"
#include "surface/label_contours.hpp"

namespace d2b {
namespace {

/// An L with a corner in the middle of a straight edge.
const PlanarPartition plan{{{0, 0}, {10, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 20}, {0, 20}}, {}};
const PartitionFace face{{0, 1, 2, 3, 4, 5, 6}, {}};

TEST(TriangulateFace, everyCornerIsUsed) {
    const auto triangles = triangulate_face(face, plan, with_geos);
    ASSERT_TRUE(triangles);
    EXPECT_EQ(triangles->size(), face.exterior.size() - 2);
}

/// What leaves the corner out has the right area, and would leave a gap beside its neighbour.
TEST(TriangulateFace, noCornerMayBeLeftOut) {
    const auto coarse = [](const FinePolygon&) {
        return std::vector<FineTriangle>{{plan.nodes[0], plan.nodes[2], plan.nodes[4]},
                                         {plan.nodes[2], plan.nodes[3], plan.nodes[4]},
                                         {plan.nodes[0], plan.nodes[4], plan.nodes[6]},
                                         {plan.nodes[4], plan.nodes[5], plan.nodes[6]}};
    };
    EXPECT_FALSE(triangulate_face(face, plan, coarse));
}

TEST(TriangulateFace, flatAndForeignTrianglesAreRefused) {
    const auto flat = [](const FinePolygon& polygon) {
        std::vector<FineTriangle> triangles = with_geos(polygon);
        triangles.push_back({polygon.exterior[0], polygon.exterior[1], polygon.exterior[0]});
        return triangles;
    };
    EXPECT_FALSE(triangulate_face(face, plan, flat));
    const auto foreign = [](const FinePolygon& polygon) {
        std::vector<FineTriangle> triangles = with_geos(polygon);
        triangles[0][0].row += 1;
        return triangles;
    };
    EXPECT_FALSE(triangulate_face(face, plan, foreign));
}

/// What fails is tried with rows and columns exchanged.
TEST(TriangulateFace, isTriedTurned) {
    int calls = 0;
    const auto fails_first = [&](const FinePolygon& polygon) {
        if (++calls == 1)
            throw GeometryError("GEOS failed.");
        return with_geos(polygon);
    };
    const auto triangles = triangulate_face(face, plan, fails_first);
    ASSERT_TRUE(triangles);
    EXPECT_EQ(calls, 2);
    EXPECT_EQ(triangles->size(), face.exterior.size() - 2);
    const auto fails = [](const FinePolygon&) -> std::vector<FineTriangle> {
        throw GeometryError("GEOS failed.");
    };
    EXPECT_FALSE(triangulate_face(face, plan, fails));
}

}  // namespace
}  // namespace d2b

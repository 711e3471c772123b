#include "surface/faces.hpp"

#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "outline/fine_geometry.hpp"
#include "surface/label_contours.hpp"
#include "surface/partition.hpp"
#include "surface/resolve_nonmanifold.hpp"

namespace d2b::surface {
namespace {

Int128 twice_area(const PartitionFace& face, const PlanarPartition& plan) {
    Int128 sum = 0;
    FinePolygon polygon = polygon_of(face, plan);
    std::vector<FineRing> rings = std::move(polygon.interiors);
    rings.push_back(std::move(polygon.exterior));
    for (const FineRing& ring : rings)
        for (std::size_t i = 1; i + 1 < ring.size(); ++i)
            sum += outline::turn(ring[0], ring[i], ring[i + 1]);
    return sum;
}

/// Rows go down once and up once along the exterior.
bool is_monotone(const PartitionFace& face, const PlanarPartition& plan) {
    const std::size_t n = face.exterior.size();
    int lowest = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const FinePoint before = plan.nodes[face.exterior[(i + n - 1) % n]];
        const FinePoint at = plan.nodes[face.exterior[i]];
        const FinePoint after = plan.nodes[face.exterior[(i + 1) % n]];
        lowest += before < at && after < at ? 1 : 0;
    }
    return lowest == 1;
}

/// The pieces have no interiors, are of the face's area together, and edges between only pieces divide it.
void expect_divided(const PartitionFace& face, const PlanarPartition& plan) {
    Int128 sum = 0;
    for (const PartitionFace& piece : split_into_monotone(face, plan)) {
        ASSERT_TRUE(piece.interiors.empty());
        ASSERT_TRUE(is_monotone(piece, plan));
        ASSERT_TRUE(twice_area(piece, plan) > 0);
        sum += twice_area(piece, plan);
    }
    ASSERT_TRUE(sum == twice_area(face, plan));
    const auto refuses_holes = [](const FinePolygon& polygon) {
        return polygon.interiors.empty() ? with_geos(polygon) : std::vector<FineTriangle>{};
    };
    const auto triangles = triangulate_face(face, plan, refuses_holes);
    ASSERT_TRUE(triangles);
    std::size_t corners = face.exterior.size();
    for (const auto& ring : face.interiors)
        corners += ring.size();
    ASSERT_EQ(triangles->size(), corners + 2 * face.interiors.size() - 2);
}

TEST(DivideFace, aCourtyard) {
    const SurfaceCluster cluster = blocks_of({{"aaa", "a a", "aaa"}}, {10});
    const PartitionResult partition = make_partition(cluster.contours);
    const std::vector<OwnedFace> faces = partition_faces(partition.plan);
    ASSERT_EQ(faces.size(), 1U);
    ASSERT_EQ(faces[0].face.interiors.size(), 1U);
    expect_divided(faces[0].face, partition.plan);
}

/// Ragged ones, straight and turned, with corners on straight edges.
TEST(DivideFace, randomFaces) {
    std::mt19937 random(3);
    int divided = 0;
    for (int run = 0; run < 300; ++run) {
        LetterGrid grid;
        for (int row = 0; row < 12; ++row) {
            std::string& line = grid.rows.emplace_back();
            for (int col = 0; col < 12; ++col)
                line += random() % 5 == 0 ? 'b' : 'a';
        }
        SurfaceCluster cluster = blocks_of(grid, {10});
        for (PartitionContour& contour : cluster.contours) {
            std::vector<FineRing*> rings{&contour.outline.exterior};
            for (FineRing& ring : contour.outline.interiors)
                rings.push_back(&ring);
            for (FineRing* ring : rings)
                for (FinePoint& p : *ring)
                    p = run % 2 == 0 ? p : FinePoint{3 * p.row - 4 * p.col, 4 * p.row + 3 * p.col};
        }
        PartitionResult partition = make_partition(cluster.contours);
        static_cast<void>(resolve_nonmanifold_vertices(partition.plan, cluster.contours));
        for (const OwnedFace& owned : partition_faces(partition.plan)) {
            expect_divided(owned.face, partition.plan);
            divided += owned.face.interiors.empty() ? 0 : 1;
        }
    }
    EXPECT_GT(divided, 100);
}

/// An L with a corner in the middle of a straight edge.
const PlanarPartition l_plan{{{0, 0}, {10, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 20}, {0, 20}}, {}};
const PartitionFace l_face{{0, 1, 2, 3, 4, 5, 6}, {}};

TEST(TriangulateFace, everyCornerIsUsed) {
    const auto triangles = triangulate_face(l_face, l_plan, with_geos);
    ASSERT_TRUE(triangles);
    EXPECT_EQ(triangles->size(), l_face.exterior.size() - 2);
}

/// Triangles that leave the corner out have the right area, and would leave a gap beside its neighbour.
TEST(TriangulateFace, noCornerMayBeLeftOut) {
    const auto coarse = [](const FinePolygon&) {
        return std::vector<FineTriangle>{{l_plan.nodes[0], l_plan.nodes[2], l_plan.nodes[4]},
                                         {l_plan.nodes[2], l_plan.nodes[3], l_plan.nodes[4]},
                                         {l_plan.nodes[0], l_plan.nodes[4], l_plan.nodes[6]},
                                         {l_plan.nodes[4], l_plan.nodes[5], l_plan.nodes[6]}};
    };
    EXPECT_FALSE(triangulate_face(l_face, l_plan, coarse));
}

TEST(TriangulateFace, flatAndForeignTrianglesAreRefused) {
    const auto flat = [](const FinePolygon& polygon) {
        std::vector<FineTriangle> triangles = with_geos(polygon);
        triangles.push_back({polygon.exterior[0], polygon.exterior[1], polygon.exterior[0]});
        return triangles;
    };
    EXPECT_FALSE(triangulate_face(l_face, l_plan, flat));
    const auto foreign = [](const FinePolygon& polygon) {
        std::vector<FineTriangle> triangles = with_geos(polygon);
        triangles[0][0].row += 1;
        return triangles;
    };
    EXPECT_FALSE(triangulate_face(l_face, l_plan, foreign));
}

/// A failed face is tried with rows and columns exchanged.
TEST(TriangulateFace, isTriedTurned) {
    int calls = 0;
    const auto fails_first = [&](const FinePolygon& polygon) {
        if (++calls == 1)
            throw GeometryError("GEOS failed.");
        return with_geos(polygon);
    };
    const auto triangles = triangulate_face(l_face, l_plan, fails_first);
    ASSERT_TRUE(triangles);
    EXPECT_EQ(calls, 2);
    EXPECT_EQ(triangles->size(), l_face.exterior.size() - 2);
    const auto fails = [](const FinePolygon&) -> std::vector<FineTriangle> {
        throw GeometryError("GEOS failed.");
    };
    EXPECT_FALSE(triangulate_face(l_face, l_plan, fails));
}

}  // namespace
}  // namespace d2b::surface

#include "surface/partition.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "surface/label_contours.hpp"
#include "surface/surface_check.hpp"

namespace d2b::surface {
namespace {

/// Counter-clockwise with y up: rows run to the south.
FinePolygon box(std::int64_t row, std::int64_t col, std::int64_t rows, std::int64_t cols) {
    return {{{row, col}, {row + rows, col}, {row + rows, col + cols}, {row, col + cols}}, {}};
}

TEST(MakePartition, edgesAreCutWhereOthersEnd) {
    const std::vector<PartitionContour> contours{{box(0, 0, 10, 10), -1, 0, 5}, {box(2, 10, 3, 4), -1, 1, 5}};
    const PartitionResult partition = make_partition(contours);
    EXPECT_TRUE(partition.conflicting.empty());
    EXPECT_EQ(partition.plan.nodes.size(), 8U);
    ASSERT_EQ(partition.plan.edges.size(), 9U);
    std::size_t common = 0;
    for (const PartitionEdge& edge : partition.plan.edges)
        common += edge.left != open_ground && edge.right != open_ground ? 1 : 0;
    EXPECT_EQ(common, 1U);
    const std::vector<FinePolygon> noded = noded_outlines(contours);
    EXPECT_EQ(noded[0].exterior.size(), 6U);
    EXPECT_EQ(noded[1].exterior.size(), 4U);
}

TEST(MakePartition, whatStandsOnAnotherTakesItsPlace) {
    const std::vector<PartitionContour> contours{
        {box(0, 0, 10, 10), -1, 0, 5}, {box(0, 0, 5, 5), 0, 0, 6}, {box(0, 0, 5, 2), 1, 0, 7}};
    const PartitionResult partition = make_partition(contours);
    EXPECT_TRUE(partition.conflicting.empty());
    for (const PartitionEdge& edge : partition.plan.edges) {
        const FinePoint a = partition.plan.nodes[edge.from];
        const FinePoint b = partition.plan.nodes[edge.to];
        if (a.col == 0 && b.col == 0) {  // the western border
            const bool upper = std::max(a.row, b.row) <= 5;
            EXPECT_EQ(std::max(edge.left, edge.right), upper ? 2 : 0);
            EXPECT_EQ(std::min(edge.left, edge.right), open_ground);
        }
    }
}

/// Each is found, and the later one named.
TEST(MakePartition, whatIsAtOdds) {
    const auto odds = [](const PartitionContour& second) {
        return make_partition(std::vector<PartitionContour>{{box(0, 0, 10, 10), -1, 0, 5}, second})
            .conflicting;
    };
    EXPECT_TRUE(odds({box(0, 10, 10, 10), -1, 1, 5}).empty());
    EXPECT_FALSE(odds({box(5, 5, 10, 10), -1, 1, 5}).empty());  // they cross
    EXPECT_FALSE(odds({box(0, 0, 10, 10), -1, 1, 5}).empty());  // they are the same
    EXPECT_FALSE(odds({box(0, 2, 5, 5), -1, 1, 5}).empty());    // it lies within, on the same side of an edge
    EXPECT_FALSE(odds({box(-5, 2, 5, 5), 0, 0, 5}).empty());    // it lies outside of its parent
    EXPECT_FALSE(odds({box(0, -5, 10, 8), 0, 0, 5}).empty());   // it reaches beyond
    for (const std::uint32_t contour : odds({box(5, 5, 10, 10), -1, 1, 5}))
        EXPECT_EQ(contour, 1U);
}

/// Overlapping buildings are left out and named, and the others are made.
TEST(MakeSurfaces, overlappingBuildings) {
    SurfaceCluster cluster;
    for (const std::int64_t col : {0, 600, 1000, 2000}) {
        const auto building = static_cast<std::int32_t>(cluster.buildings.size());
        cluster.buildings.push_back({40 + building, 0});
        cluster.contours.push_back({box(10 * col / 1000, col, 1000, 1000), -1, building, 10});
    }
    const MadeSurfaces made = surfaces_of(cluster);
    EXPECT_EQ(made.left_out, (std::vector<std::int64_t>{41, 42}));
    EXPECT_EQ(made.shell.size(), 2U);
    EXPECT_EQ(fault_of(made.shell), "");
}

/// Triangles are checked, whoever makes them, and a building that has none is left out.
TEST(MakeSurfaces, aBuildingThatCannotBeDivided) {
    const SurfaceCluster cluster = blocks_of({{"aa b", "a  b"}}, {20, 30});
    const auto refuses_all = [](const FinePolygon&) { return std::vector<FineTriangle>{}; };
    const MadeSurfaces none = make_surfaces(cluster, {true, true}, refuses_all);
    EXPECT_EQ(none.left_out, (std::vector<std::int64_t>{100, 101}));
    EXPECT_TRUE(none.shell.empty());
    const auto refuses_concave = [](const FinePolygon& polygon) {
        return polygon.exterior.size() > 4 ? std::vector<FineTriangle>{} : with_geos(polygon);
    };
    const MadeSurfaces rest = make_surfaces(cluster, {true, true}, refuses_concave);
    EXPECT_EQ(rest.left_out, (std::vector<std::int64_t>{100}));
    ASSERT_EQ(rest.solids.size(), 1U);
    EXPECT_EQ(rest.solids[0].buildings[0].id, 101);
    EXPECT_EQ(fault_of(rest.shell), "");
}

}  // namespace
}  // namespace d2b::surface

#include <algorithm>

#include <gtest/gtest.h>

#include "surface/label_contours.hpp"
#include "surface/partition.hpp"
#include "surface/surface_check.hpp"
#include "surface/vertex_snapping.hpp"

namespace d2b {
namespace {

/// Houses side by side, each a ring in steps.
SurfaceCluster houses(const std::vector<FineRing>& rings, const std::vector<std::int64_t>& tops) {
    SurfaceCluster cluster;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        const auto building = static_cast<std::int32_t>(i);
        cluster.buildings.push_back({100 + building, 0});
        cluster.contours.push_back({{rings[i], {}}, -1, building, tops[i]});
    }
    return cluster;
}

PlanarPartition merged(const SurfaceCluster& cluster, const LatticeDistance& gap) {
    PlanarPartition plan = make_partition(cluster.contours).plan;
    merge_near_nodes(plan, gap);
    return plan;
}

/// The ends of a wall of three steps become one corner, with a gap of four steps; with one of three they
/// stay.
TEST(MergeNear, aShortWall) {
    const SurfaceCluster house = houses({{{0, 0}, {1000, 0}, {1000, 700}, {997, 700}, {0, 1000}}}, {50});
    const PlanarPartition plan = merged(house, {4, 4});
    EXPECT_EQ(plan.nodes.size(), 4U);
    EXPECT_EQ(plan.edges.size(), 4U);
    EXPECT_EQ(merged(house, {3, 3}).nodes.size(), 5U);
}

/// In a lattice whose rows are long, neighbours along a column are far apart.
TEST(MergeNear, eachAxisForItself) {
    const SurfaceCluster house = houses({{{0, 0}, {1000, 0}, {1000, 700}, {997, 700}, {0, 1000}}}, {50});
    EXPECT_EQ(merged(house, {2, 9}).nodes.size(), 5U);
    EXPECT_EQ(merged(house, {4, 1}).nodes.size(), 4U);
}

/// The corner of a house that almost touches another's: they touch then, and are parted as such are.
TEST(MergeNear, cornersAcrossANarrowGap) {
    const SurfaceCluster two = houses({{{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}},
                                       {{1002, 1001}, {2000, 1001}, {2000, 2000}, {1002, 2000}}},
                                      {50, 70});
    EXPECT_EQ(merged(two, {3, 3}).nodes.size(), 7U);
    const MadeSurfaces made = surfaces_of(two, {{21, 21}, {3, 3}});
    ASSERT_EQ(made.repairs.size(), 1U);
    EXPECT_TRUE(LatticeDistance({21, 21}).parts(made.repairs[0].place, made.repairs[0].moved));
    EXPECT_EQ(fault_of(made.shell), "");
    EXPECT_EQ(made.shell.size(), 2U);
    EXPECT_TRUE(surfaces_of(two, {{21, 21}, {2, 2}}).repairs.empty()) << "two rows apart";
}

/// Of near corners on both sides of zero, in rows and columns.
TEST(MergeNear, cornersAroundTheOrigin) {
    const SurfaceCluster house = houses({{{-1, -1}, {1, 2}, {1000, 700}, {-900, 900}}}, {50});
    EXPECT_EQ(merged(house, {4, 4}).nodes.size(), 3U);
    EXPECT_EQ(merged(house, {2, 3}).nodes.size(), 4U);
}

/// A wall of a millimetre is none: both roofs are at the higher height. One of two is.
TEST(MergeNear, roofsAMillimetreApart) {
    const auto tops = [](std::int64_t a, std::int64_t b, std::int64_t c) {
        const SurfaceCluster cluster = blocks_of({{"abc"}}, {a, b, c});
        std::vector<PartitionContour> contours = cluster.contours;
        level_near_roofs(make_partition(contours).plan, contours, 2);
        return std::vector{contours[0].top, contours[1].top, contours[2].top};
    };
    EXPECT_EQ(tops(50, 51, 90), (std::vector<std::int64_t>{51, 51, 90}));
    EXPECT_EQ(tops(50, 52, 90), (std::vector<std::int64_t>{50, 52, 90}));
    EXPECT_EQ(tops(50, 51, 52), (std::vector<std::int64_t>{52, 52, 52}))
        << "raised, it is a step lower again";
    EXPECT_EQ(tops(50, 90, 51), (std::vector<std::int64_t>{50, 90, 51})) << "they do not meet";
    EXPECT_EQ(fault_of(surfaces_of(blocks_of({{"abc"}}, {50, 51, 52}), {{2, 2}, {1, 1}, 2}).shell), "");
}

/// What stands a millimetre high is no solid.
TEST(MergeNear, aHouseOfAMillimetre) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"ab"}}, {1, 2}), {{2, 2}, {1, 1}, 2});
    ASSERT_EQ(made.solids.size(), 1U);
    EXPECT_EQ(made.solids[0].buildings[0].id, blocks_of({{"ab"}}, {1, 2}).buildings[1].id);
    EXPECT_EQ(fault_of(made.solids), "");
}

}  // namespace
}  // namespace d2b

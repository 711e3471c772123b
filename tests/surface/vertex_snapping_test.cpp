#include "surface/vertex_snapping.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "surface/label_contours.hpp"
#include "surface/partition.hpp"
#include "surface/surface_check.hpp"

namespace d2b::surface {
namespace {

bool is_sound(const std::vector<PartitionContour>& contours) {
    return make_partition(contours).conflicting.empty();
}

/// Rows run to the south: down, to the east, and back.
PartitionContour house_of(FineRing ring, std::int32_t building, std::int64_t top = 10) {
    return {{std::move(ring), {}}, -1, building, top};
}

/// The corner of a house has come to lie a step within the wall of another.
TEST(SnapRound, aCornerBehindAWall) {
    std::vector<PartitionContour> contours{house_of({{0, 0}, {1000, 2}, {1000, 1000}, {0, 1000}}, 0),
                                           house_of({{300, -500}, {700, -500}, {500, 2}}, 1)};
    ASSERT_FALSE(is_sound(contours));
    snap_round(contours);
    EXPECT_TRUE(is_sound(contours));
    EXPECT_EQ(contours[0].outline.exterior, (FineRing{{0, 0}, {500, 2}, {1000, 2}, {1000, 1000}, {0, 1000}}));
    EXPECT_EQ(contours[1].outline.exterior, (FineRing{{300, -500}, {700, -500}, {500, 2}}));
}

/// Contours that are not at odds are not changed, however near their corners lie.
TEST(SnapRound, whatIsSoundStays) {
    std::vector<PartitionContour> contours{house_of({{0, 0}, {1000, 2}, {1000, 1000}, {0, 1000}}, 0),
                                           house_of({{300, -500}, {700, -500}, {500, 0}}, 1)};
    ASSERT_TRUE(is_sound(contours));
    const FineRing before = contours[0].outline.exterior;
    snap_round(contours);
    EXPECT_EQ(contours[0].outline.exterior, before);
}

/// A needle with a tip that has come to lie beyond its other wall: its rest is not passed there and back.
TEST(SnapRound, aNeedleThatTurnedOver) {
    std::vector<PartitionContour> contours{house_of(
        {{0, 0}, {1000, 0}, {1000, 1000}, {501, 1000}, {500, 1900}, {501, 1950}, {500, 1000}, {0, 1000}}, 0)};
    ASSERT_FALSE(is_sound(contours));
    snap_round(contours);
    EXPECT_TRUE(is_sound(contours));
    const FineRing& ring = contours[0].outline.exterior;
    for (std::size_t i = 0; i < ring.size(); ++i)
        EXPECT_NE(ring[i], ring[(i + 2) % ring.size()]);
}

/// A house no wider than a step is not taken for one of no area: it stays at odds, and is found to be.
TEST(SnapRound, aHouseThatIsGoneIsFound) {
    std::vector<PartitionContour> contours{house_of({{0, 0}, {1, 500}, {0, 1000}, {0, 400}}, 0)};
    snap_round(contours);
    EXPECT_GT(contours[0].outline.exterior.size(), 2U);
}

/// A place off the beginning of a wall that runs at an angle: along it, and to its left. Rounded.
FinePoint rounded(double angle, double along, double left) {
    return {-std::llround(along * std::sin(angle) + left * std::cos(angle)),
            std::llround(along * std::cos(angle) - left * std::sin(angle))};
}

/// A house whose long wall runs past the tips of others, which are less than a step off, and past those of
/// its own towers. All are counter-clockwise and apart before they are rounded.
std::vector<PartitionContour> tips_beside_a_wall(std::mt19937& random) {
    const double angle = 0.001 * static_cast<double>(random() % 6283);
    const auto at = [&](double along, double left) { return rounded(angle, along, left); };
    std::vector<PartitionContour> contours{house_of({at(0, 0), at(2000, 0), at(2000, 500), at(0, 500)}, 0)};
    for (std::int32_t i = 1; i < 10; ++i) {
        const double off = 0.01 * static_cast<double>(1 + random() % 99);
        const double along = 200 * i + 0.1 * static_cast<double>(random() % 100);
        if (i % 3 == 0) {
            contours.push_back(house_of({at(along, off), at(along + 70, 200), at(along - 70, 200)}, 0, 20));
            contours.back().parent = 0;
        } else {
            contours.push_back(house_of({at(along, -off), at(along - 70, -200), at(along + 70, -200)}, i));
        }
    }
    return contours;
}

/// Whichever way they are rounded, all of it can be built, and no corner has moved.
TEST(SnapRound, randomTips) {
    std::mt19937 random(7);
    int conflicting = 0;
    for (int run = 0; run < 300; ++run) {
        std::vector<PartitionContour> contours = tips_beside_a_wall(random);
        const std::vector<PartitionContour> before = contours;
        conflicting += is_sound(contours) ? 0 : 1;
        snap_round(contours);
        ASSERT_TRUE(is_sound(contours)) << run;
        for (std::size_t i = 0; i < contours.size(); ++i)
            for (const FinePoint& corner : before[i].outline.exterior)
                ASSERT_EQ(std::ranges::count(contours[i].outline.exterior, corner), 1) << run;
    }
    EXPECT_GT(conflicting, 100);
}

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
TEST(MergeNearNodes, aShortWall) {
    const SurfaceCluster house = houses({{{0, 0}, {1000, 0}, {1000, 700}, {997, 700}, {0, 1000}}}, {50});
    const PlanarPartition plan = merged(house, {4, 4});
    EXPECT_EQ(plan.nodes.size(), 4U);
    EXPECT_EQ(plan.edges.size(), 4U);
    EXPECT_EQ(merged(house, {3, 3}).nodes.size(), 5U);
}

/// Neighbours along a column are far apart in a lattice with long rows.
TEST(MergeNearNodes, eachAxisForItself) {
    const SurfaceCluster house = houses({{{0, 0}, {1000, 0}, {1000, 700}, {997, 700}, {0, 1000}}}, {50});
    EXPECT_EQ(merged(house, {2, 9}).nodes.size(), 5U);
    EXPECT_EQ(merged(house, {4, 1}).nodes.size(), 4U);
}

/// The corner of a house that almost touches another's: they touch then, and are parted as such are.
TEST(MergeNearNodes, cornersAcrossANarrowGap) {
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

/// A house with near corners on both sides of zero, in rows and columns.
TEST(MergeNearNodes, cornersAroundTheOrigin) {
    const SurfaceCluster house = houses({{{-1, -1}, {1, 2}, {1000, 700}, {-900, 900}}}, {50});
    EXPECT_EQ(merged(house, {4, 4}).nodes.size(), 3U);
    EXPECT_EQ(merged(house, {2, 3}).nodes.size(), 4U);
}

/// A wall of a millimetre is none: both roofs are at the higher height. One of two is.
TEST(MergeNearNodes, roofsAMillimetreApart) {
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

/// A house a millimetre high is no solid.
TEST(MergeNearNodes, aHouseOfAMillimetre) {
    const MadeSurfaces made = surfaces_of(blocks_of({{"ab"}}, {1, 2}), {{2, 2}, {1, 1}, 2});
    ASSERT_EQ(made.solids.size(), 1U);
    EXPECT_EQ(made.solids[0].buildings[0].id, blocks_of({{"ab"}}, {1, 2}).buildings[1].id);
    EXPECT_EQ(fault_of(made.solids), "");
}

}  // namespace
}  // namespace d2b::surface

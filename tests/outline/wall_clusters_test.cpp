#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "outline/packed_outline.hpp"
#include "outline/walls/fit_walls.hpp"
#include "support/outline_checks.hpp"
#include "support/trace_grid.hpp"

namespace d2b::outline {
namespace {

using test::ContourVector;
using test::trace_grid;
using test::TraceGrid;

/// Contours of a grid without the roots, as detection leaves them.
ContourVector without_roots(const test::ContourSet& set) {
    std::vector<contours::Contour> contours;
    std::int64_t roots = 0;
    for (const contours::Contour& contour : set.contours) {
        if (contour.key.level == 0) {
            ++roots;
            continue;
        }
        contours::Contour kept = contour;
        kept.parent = kept.key.level == 1 ? -1 : kept.parent - roots;
        contours.push_back(kept);
    }
    return ContourVector(std::move(contours));
}

void raise(TraceGrid& grid, LatticeBox box, double z) {
    for (std::int32_t row = box.low.row; row < box.high.row; ++row)
        for (std::int32_t col = box.low.col; col < box.high.col; ++col)
            grid.z[static_cast<std::size_t>(row * grid.cols + col)] = z;
}

/// Two houses of 12 x 12 cells with so many cells between them.
ContourVector two_houses(std::int32_t gap, bool with_tower = false) {
    TraceGrid grid{20, 28 + gap, {}, {}};
    grid.z.assign(static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.cols), 0);
    raise(grid, {{4, 2}, {16, 14}}, 10);
    raise(grid, {{4, 14 + gap}, {16, 26 + gap}}, 10);
    if (with_tower)
        raise(grid, {{9, 7}, {11, 9}}, 20);
    Context context;
    return without_roots(trace_grid(grid, {5, 15}, {}, context));
}

const WallOptions usual{Walls::automatic, 1.5, {}};

TEST(WallClusters, HousesACellApartAreTogetherAndFarOnesAreNot) {
    EXPECT_EQ(wall_clusters(two_houses(1), usual).size(), 1U);
    EXPECT_EQ(wall_clusters(two_houses(20), usual).size(), 2U);
    // Both walls may leave their traces by 1.5 cells.
    EXPECT_EQ(wall_clusters(two_houses(3), usual).size(), 1U);
    EXPECT_EQ(wall_clusters(two_houses(5), usual).size(), 2U);
}

TEST(WallClusters, WideCellsReachFewerColumns) {
    const WallOptions wide{Walls::automatic, 1.5, {{2, 0}, {0, 0.5}}};
    EXPECT_EQ(wall_clusters(two_houses(1), wide).size(), 1U);
    EXPECT_EQ(wall_clusters(two_houses(3), wide).size(), 2U);
}

TEST(WallClusters, WhatStandsOnAHouseIsWithIt) {
    const ContourVector contours = two_houses(20, true);
    ASSERT_EQ(contours.size(), 3U);
    const std::vector<ClusterPlan> clusters = wall_clusters(contours, usual);
    ASSERT_EQ(clusters.size(), 2U);
    EXPECT_EQ(clusters[0].numbers, (std::vector<std::uint32_t>{0, 2}));
    EXPECT_EQ(clusters[0].parents, (std::vector<std::int32_t>{-1, 0}));
    EXPECT_EQ(clusters[1].numbers, (std::vector<std::uint32_t>{1}));
    const WallCluster first = fetch_cluster(contours, clusters[0]);
    EXPECT_EQ(first.contours[1].key, contours.head(2).key);
    EXPECT_EQ(first.parents, clusters[0].parents);
    EXPECT_EQ(fit_walls(first, usual).footprints.size(), 1U);
    EXPECT_TRUE(fit_walls(fetch_cluster(contours, clusters[1]), usual).footprints.empty());
}

/// Ragged houses of some levels all over a grid.
ContourVector village(unsigned seed) {
    std::mt19937 random(seed);
    TraceGrid grid{150, 150, std::vector<double>(150 * 150, 0), {}};
    for (int house = 0; house < 40; ++house) {
        const LatticePoint at{static_cast<std::int32_t>(random() % 130),
                              static_cast<std::int32_t>(random() % 130)};
        const auto rows = static_cast<std::int32_t>(4 + random() % 14);
        const auto cols = static_cast<std::int32_t>(4 + random() % 14);
        for (std::int32_t row = 0; row < rows; ++row)
            raise(grid,
                  {{at.row + row, at.col + row / 3 % 2},
                   {at.row + row + 1, at.col + cols + static_cast<std::int32_t>(random() % 3)}},
                  10.0 + 10.0 * static_cast<double>(house % 3));
    }
    Context context;
    return without_roots(trace_grid(grid, {5, 15, 25}, {}, context));
}

void expect_same(const FinePolygon& a, const FinePolygon& b) {
    EXPECT_EQ(a.exterior, b.exterior);
    EXPECT_EQ(a.interiors, b.interiors);
}

class Village : public testing::TestWithParam<unsigned> {};

TEST_P(Village, IsTheSameWithAnyNumberOfThreads) {
    const ContourVector contours = village(GetParam());
    Executor one(1);
    const RegularizedOutlines alone(contours, usual, std::make_unique<MemorySpool>(), one);
    for (const int threads : {2, 5}) {
        Executor several(threads);
        const RegularizedOutlines shared(contours, usual, std::make_unique<MemorySpool>(), several);
        for (std::size_t i = 0; i < contours.size(); ++i) {
            expect_same(shared.polygon(i), alone.polygon(i));
            EXPECT_EQ(shared.quality(i).deviation_cells, alone.quality(i).deviation_cells);
            if (contours.head(i).key.level == 1)
                expect_same(shared.footprint(i), alone.footprint(i));
        }
    }
}

TEST_P(Village, AClusterAloneIsDrawnAsAmongAll) {
    const ContourVector contours = village(GetParam());
    Executor executor(2);
    const RegularizedOutlines all(contours, usual, std::make_unique<MemorySpool>(), executor);
    const std::vector<ClusterPlan> clusters = wall_clusters(contours, usual);
    ASSERT_GT(clusters.size(), 2U);
    for (const ClusterPlan& cluster : clusters) {
        std::vector<contours::Contour> of_cluster;
        for (std::size_t i = 0; i < cluster.numbers.size(); ++i) {
            of_cluster.push_back(contours.fetch(cluster.numbers[i]));
            of_cluster.back().parent = cluster.parents[i];
        }
        const ContourVector own(of_cluster);
        ASSERT_EQ(wall_clusters(own, usual).size(), 1U);
        const RegularizedOutlines alone(own, usual, std::make_unique<MemorySpool>(), executor);
        for (std::size_t i = 0; i < own.size(); ++i) {
            expect_same(alone.polygon(i), all.polygon(cluster.numbers[i]));
            expect_same(alone.traced(i), all.traced(cluster.numbers[i]));
            if (own.head(i).key.level == 1)
                expect_same(alone.footprint(i), all.footprint(cluster.numbers[i]));
        }
    }
}

TEST_P(Village, FootprintsAreThoseOfTheLowLevelsAlone) {
    const ContourVector contours = village(GetParam());
    Executor executor;
    const RegularizedOutlines all(contours, usual, std::make_unique<MemorySpool>(), executor);
    for (std::size_t i = 0; i < contours.size() && contours.head(i).key.level <= 1; ++i) {
        const FineRing plate = all.polygon(i).exterior;
        const FineRing footprint = all.footprint(i).exterior;
        const std::set<FinePoint> of_plate(plate.begin(), plate.end());
        EXPECT_TRUE(std::ranges::all_of(footprint, [&](FinePoint p) { return of_plate.contains(p); }));
        // Its additional points are on its walls, as near as the fine lattice allows.
        EXPECT_LE(test::one_sided(plate, footprint), 1.0 / FinePoint::steps);
        EXPECT_LE(test::one_sided(footprint, plate), 1.0 / FinePoint::steps);
    }
}

TEST_P(Village, IsDividedAlikeInStripsOfAnyHeight) {
    const ContourVector contours = village(GetParam());
    const std::vector<ClusterPlan> whole = wall_clusters(contours, usual);
    for (const std::int64_t rows : {1, 7, 64}) {
        const std::vector<ClusterPlan> strips = wall_clusters(contours, usual, {}, rows);
        ASSERT_EQ(strips.size(), whole.size());
        for (std::size_t i = 0; i < whole.size(); ++i)
            EXPECT_EQ(strips[i].numbers, whole[i].numbers);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Village, testing::Range(0U, 6U));

FinePolygon put_aside(const FinePolygon& polygon) {
    MemorySpool spool;
    ByteWriter writer;
    save(polygon, writer);
    return load_outline(spool, append(spool, writer));
}

TEST(PackedOutline, GivesBackWhatWasPutIn) {
    const FinePolygon polygon{{{-5, 7}, {1LL << 40, -(1LL << 39)}, {1024, 2048}},
                              {{{0, 0}, {63, -64}, {64, -65}}},
                              {{1, 0, 4000000000U}}};
    const FinePolygon back = put_aside(polygon);
    expect_same(back, polygon);
    ASSERT_EQ(back.arcs.size(), 1U);
    EXPECT_EQ(back.arcs[0].ring, 1U);
    EXPECT_EQ(back.arcs[0].edges, 4000000000U);
    EXPECT_TRUE(put_aside({}).exterior.empty());
}

}  // namespace
}  // namespace d2b::outline

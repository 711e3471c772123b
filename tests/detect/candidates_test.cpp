#include "detect/candidates.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "detect/detection.hpp"
#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b::detect {
namespace {

using namespace test;

using Cells = std::vector<FirstCell>;

/// Three flat roofs of 10 x 10 cells: at rows 5, 25 and 45, of 8, 5 and 1.5 m.
Town three_roofs() {
    Town town(60, 40);
    town.block(5, 10, 15, 20, 108);
    town.block(25, 10, 35, 20, 105);
    town.block(45, 10, 55, 20, 101.5F);
    return town;
}

DetectOptions least(double height) {
    DetectOptions options;
    options.min_height = height;
    return options;
}

TEST(RejectedObjects, SmallRegionsGoAndAreToldByTheirFirstCells) {
    Regions regions = connected_regions(drawn({"##..#",  //
                                               "##...",  //
                                               "....#",  //
                                               ".####"}),
                                        1, 0, threads());
    EXPECT_EQ(remove_small(regions, 4), (Cells{{0, 4}}));
    EXPECT_EQ(drawing(mask_of(regions, threads())),
              (std::vector<std::string>{"##...", "##...", "....#", ".####"}));
    EXPECT_EQ(remove_small(regions, 5), (Cells{{0, 0}}));
    EXPECT_EQ(remove_small(regions, 6), (Cells{{2, 4}}));
}

TEST(RejectedObjects, BelowTheSmallestArea) {
    const Town town = three_roofs();
    EXPECT_EQ(detect_in(town, least(1), 30).rejected.small, Cells{});
    const Detection none = detect_in(town, least(1), 500);
    EXPECT_EQ(none.rejected.small, (Cells{{5, 11}, {25, 11}, {45, 11}}));  // corners are rounded off
    EXPECT_TRUE(none.objects.empty());
}

TEST(RejectedObjects, BelowTheSmallestHeight) {
    const Town town = three_roofs();
    EXPECT_EQ(detect_in(town, least(1), 30).rejected.low, Cells{});
    EXPECT_EQ(detect_in(town, least(2), 30).rejected.low, (Cells{{45, 10}}));
    EXPECT_EQ(detect_in(town, least(6), 30).rejected.low, (Cells{{25, 10}, {45, 10}}));
    EXPECT_EQ(detect_in(town, least(50), 30).rejected.low, (Cells{{5, 10}, {25, 10}, {45, 10}}));
    EXPECT_EQ(detect_in(town, least(50), 150).rejected.low, Cells{}) << "smaller than a building";
}

TEST(RejectedObjects, NotWhereNoBuildingMayBe) {
    const Town town = three_roofs();
    Mask upper(60, 40);
    std::fill(upper.row(0).begin(), upper.row(39).end(), std::uint8_t{1});
    Scene scene = town.scene();
    scene.allowed = &upper;
    Context context;
    EXPECT_EQ(detect_buildings(scene, least(50), 30, context).rejected.low, (Cells{{5, 10}, {25, 10}}));
}

TEST(Scene, CellsForAnArea) {
    EXPECT_EQ(cells_covering(30, {1, 1}), 30);
    EXPECT_EQ(cells_covering(30, {0.5, 0.5}), 120);
    EXPECT_EQ(cells_covering(30.1, {0.5, 0.5}), 121);
    EXPECT_EQ(cells_covering(30, {1, 2, 0.5}), 30) << "a sheared cell of 1 m2";
    EXPECT_EQ(cells_covering(0, {1, 1}), 0);
    // More than any raster has, and no overflow.
    for (const double area : {1e19, 1e308, std::numeric_limits<double>::infinity()})
        EXPECT_GT(cells_covering(area, {0.5, 0.5}), std::int64_t{1} << 60) << area;
}

/// A block of 10 m, 8 x 8 cells in the middle of 12 x 12, with a border of another height.
struct BorderedBlock {
    explicit BorderedBlock(float border) {
        surface = MetreGrid(12, 12);
        terrain = MetreGrid(12, 12);
        cells = Mask(12, 12);
        for (std::int32_t row = 2; row < 10; ++row)
            for (std::int32_t col = 2; col < 10; ++col) {
                const bool inner = row > 2 && row < 9 && col > 2 && col < 9;
                surface.values[surface.index(row, col)] = inner ? 10 : border;
                cells.values[cells.index(row, col)] = 1;
            }
    }
    [[nodiscard]] std::int64_t left() {
        Executor threads(2);
        remove_blurred_edge({surface, terrain, {1, 1}}, cells, threads);
        return std::count(cells.values.begin(), cells.values.end(), 1);
    }
    MetreGrid surface;
    MetreGrid terrain;
    Mask cells;
};

/// Cells of 3 x 3 cells, 5 m high, after their border has grown over 3 x 5 elevated cells beside them.
std::int64_t cells_beside(float elevation, double side) {
    Town town(9, 12, {side, side});
    town.block(3, 1, 6, 4, 105);
    Mask objects = raised(town);
    town.block(3, 4, 6, 9, elevation);
    Executor threads(2);
    const Mask grown = grow_border(town.scene(), std::move(objects), raised(town), threads);
    return std::count(grown.values.begin(), grown.values.end(), 1);
}

TEST(GrownBorder, CellsOfACrownDoNotGrowBack) {
    EXPECT_EQ(cells_beside(103, 0.5), 3 * (3 + 3));
    EXPECT_EQ(cells_beside(106.1F, 0.5), 3 * (3 + 3));
    EXPECT_EQ(cells_beside(106.3F, 0.5), 3 * 3);
    EXPECT_EQ(cells_beside(106.3F, 2.5), 3 * (3 + 2)) << "coarse cells";
}

TEST(GrownBorder, CellsBehindACrownAreNotReached) {
    Town town(3, 9, {0.5, 0.5});
    town.block(0, 0, 3, 3, 105);
    Mask objects = raised(town);
    town.block(0, 3, 3, 4, 109);
    town.block(0, 4, 3, 9, 105);
    Executor threads(2);
    const Mask grown = grow_border(town.scene(), objects, raised(town), threads);
    EXPECT_EQ(grown.values, objects.values);
}

TEST(BlurredEdge, IsTakenOffBelowHalfTheHeightBesideIt) {
    EXPECT_EQ(BorderedBlock(4.9F).left(), 36);
    EXPECT_EQ(BorderedBlock(5.1F).left(), 64);
}

TEST(BlurredEdge, OneCellAloneIsTakenOff) {
    BorderedBlock block(10);
    block.surface.values[block.surface.index(5, 2)] = 3;
    EXPECT_EQ(block.left(), 63);
    EXPECT_EQ(block.cells.values[block.cells.index(5, 2)], 0);
}

TEST(BlurredEdge, WhatHasNoInsideKeepsItsBorder) {
    BorderedBlock block(3);
    for (std::int32_t row = 0; row < 12; ++row)
        for (std::int32_t col = 0; col < 12; ++col)
            if (row > 3)
                block.cells.values[block.cells.index(row, col)] = 0;
    EXPECT_EQ(block.left(), 16);  // two rows of eight
}

}  // namespace
}  // namespace d2b::detect

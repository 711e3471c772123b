#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "detect/divide_buildings.hpp"
#include "detect/regions.hpp"
#include "detect_case.hpp"

namespace d2b {
namespace {

using test::cells_with;
using test::drawing;
using test::Town;

/// Which parcel a cell's middle is in, by row and column.
using Parcels = std::function<std::int64_t(std::int32_t, std::int32_t)>;

ParcelGrid grid_of(const Town& town, const Parcels& parcels) {
    ParcelGrid grid(town.surface.rows, town.surface.cols);
    for (std::int32_t r = 0; r < grid.rows; ++r)
        for (std::int32_t c = 0; c < grid.cols; ++c)
            grid.at(r, c).parcel = parcels(r, c);
    return grid;
}

Detection detect_cut(const Town& town, const ParcelGrid& parcels, const DetectOptions& options = {},
                     double min_area_m2 = default_min_building_m2) {
    Context context;
    Scene scene = town.scene();
    scene.parcels = &parcels;
    return detect_buildings(scene, options, min_area_m2, context);
}

/// Cells that detection sees in the box, with another label than the rest of it.
std::int64_t cells_of(const Detection& found, std::int64_t parcel) {
    std::int64_t cells = 0;
    for (const DetectedObject& object : found.objects)
        cells += object.parcel == parcel ? object.cells : 0;
    return cells;
}

/// Ten metres deep, sixty long.
Town terrace() {
    Town town(30, 80);
    town.block(10, 10, 20, 70, 107);
    return town;
}
std::int64_t house_of(std::int32_t, std::int32_t col) {
    return col / 10;  // 1 to 6 in the terrace
}

TEST(CutByParcels, ATerraceBecomesHouses) {
    const Town town = terrace();
    const Detection whole = test::detect(town);
    ASSERT_EQ(whole.buildings, 1U);
    const Detection found = detect_cut(town, grid_of(town, house_of));
    ASSERT_EQ(found.buildings, 6U);
    EXPECT_EQ(drawing(test::building_mask(found)), drawing(test::building_mask(whole)));
    for (std::int64_t i = 0; i < 6; ++i) {
        const DetectedObject& house = found.objects[static_cast<std::size_t>(i)];
        EXPECT_EQ(house.parcel, i + 1);
        EXPECT_EQ(house.cells, i == 0 || i == 5 ? 98 : 100);  // the corners of the block are none of it
        EXPECT_EQ(house.confidence, whole.objects[0].confidence);
    }
    for (std::int32_t r = 0; r < town.surface.rows; ++r)
        for (std::int32_t c = 0; c < town.surface.cols; ++c)
            if (const Label label = found.labels.at(r, c); label != 0) {
                EXPECT_EQ(found.objects[label - 1].parcel, house_of(r, c));
            }
    EXPECT_TRUE(found.rejected.parts.empty());
}

TEST(CutByParcels, LinesCutWhereTheyCross) {
    const Town town = terrace();
    ParcelGrid lines(town.surface.rows, town.surface.cols);
    for (std::int32_t r = 0; r < lines.rows; ++r) {
        lines.at(r, 29).cut_right = true;
        lines.at(r, 49).cut_right = r < 16;  // ends within the block
    }
    const Detection found = detect_cut(town, lines);
    ASSERT_EQ(found.buildings, 2U);
    EXPECT_EQ(found.objects[0].cells, 198);
    EXPECT_EQ(found.objects[1].cells, 398);
    for (const DetectedObject& object : found.objects)
        EXPECT_EQ(object.parcel, ParcelCell::no_parcel);
}

/// The alley behind all houses reaches a cell into the block.
TEST(CutByParcels, ASliverGoesBackToTheHousesBesideIt) {
    const Town town = terrace();
    const Detection found = detect_cut(
        town, grid_of(town, [](std::int32_t r, std::int32_t c) { return r >= 19 ? 99 : house_of(r, c); }));
    ASSERT_EQ(found.buildings, 6U);
    for (std::int64_t i = 0; i < 6; ++i)
        EXPECT_EQ(found.objects[static_cast<std::size_t>(i)].cells, i == 0 || i == 5 ? 98 : 100) << i;
    EXPECT_EQ(found.rejected.parts.size(), 1U);
    EXPECT_EQ(found.rejected.parts.front(), (FirstCell{19, 11}));
    DetectOptions all;
    all.split_width = 0;
    EXPECT_EQ(
        detect_cut(
            town, grid_of(town, [](std::int32_t r, std::int32_t c) { return r >= 19 ? 99 : house_of(r, c); }),
            all)
            .buildings,
        7U);
}

/// As above, where the alley is that of the first house.
TEST(CutByParcels, ATailGoesBackToTheHousesBesideIt) {
    const Town town = terrace();
    const Detection found = detect_cut(
        town, grid_of(town, [](std::int32_t r, std::int32_t c) { return r >= 19 ? 1 : house_of(r, c); }));
    ASSERT_EQ(found.buildings, 6U);
    EXPECT_NEAR(static_cast<double>(cells_of(found, 1)), 100, 4);
    EXPECT_NEAR(static_cast<double>(cells_of(found, 4)), 100, 4);
}

TEST(CutByParcels, ASmallPartGoesToTheNeighbourItSharesMostWith) {
    const Town town = terrace();
    // Four by four in a corner of the third house: beside it by seven edges, the second by four.
    const auto parcels = [](std::int32_t r, std::int32_t c) -> std::int64_t {
        return r < 14 && c >= 30 && c < 34 ? 77 : house_of(r, c);
    };
    const Detection found = detect_cut(town, grid_of(town, parcels), {}, 20);
    ASSERT_EQ(found.buildings, 6U);
    EXPECT_EQ(cells_of(found, 3), 100);
    EXPECT_EQ(found.rejected.parts.size(), 1U);
    EXPECT_EQ(detect_cut(town, grid_of(town, parcels), {}, 10).buildings, 7U);
}

/// The walls stand where the surface steps, a metre beside the parcels.
TEST(CutByParcels, ACutBesideAWallIsThatWall) {
    Town town(30, 80);
    for (std::int32_t house = 1; house <= 6; ++house)
        town.block(10, 10 * house, 20, 10 * house + 10, house % 2 == 0 ? 107.0F : 110.0F);
    const auto shifted = [](std::int32_t r, std::int32_t c) { return house_of(r, c - 1); };
    const Detection found = detect_cut(town, grid_of(town, shifted));
    ASSERT_EQ(found.buildings, 6U);
    for (std::int32_t r = 0; r < town.surface.rows; ++r)
        for (std::int32_t c = 0; c < town.surface.cols; ++c)
            if (const Label label = found.labels.at(r, c); label != 0) {
                EXPECT_EQ(found.objects[label - 1].parcel, house_of(r, c)) << r << " " << c;
            }
    // Three metres are another wall.
    const Detection far =
        detect_cut(town, grid_of(town, [](std::int32_t r, std::int32_t c) { return house_of(r, c - 3); }));
    EXPECT_EQ(far.labels.at(15, 41), far.labels.at(15, 39));
    EXPECT_NE(far.labels.at(15, 44), far.labels.at(15, 41));
}

TEST(CutByParcels, ANarrowBuildingStaysWhole) {
    Town town(30, 80);
    town.block(10, 10, 14, 70, 107);
    DetectOptions wide;
    wide.split_width = 12;
    const Detection found = detect_cut(town, grid_of(town, house_of), wide);
    ASSERT_EQ(found.buildings, 1U);
    EXPECT_EQ(found.rejected.parts.size(), 5U);
}

TEST(CutByParcels, StepsDivideThePartsFurther) {
    Town town = terrace();
    town.block(10, 36, 20, 40, 112);
    DetectOptions steps;
    steps.split_height = 3;
    EXPECT_EQ(test::detect(town, steps).buildings, 3U);
    const Detection found = detect_cut(town, grid_of(town, house_of), steps);
    ASSERT_EQ(found.buildings, 7U);
    EXPECT_EQ(cells_of(found, 3), 100);  // of two buildings
}

TEST(CutByParcels, WhatIsNotCutSaysItsParcel) {
    Town town = terrace();
    const Detection found =
        detect_cut(town, grid_of(town, [](std::int32_t r, std::int32_t) { return r < 30 ? 5 : 6; }));
    ASSERT_EQ(found.buildings, 1U);
    EXPECT_EQ(found.objects[0].parcel, 5);
}

/// Parts cover what was there, hang together, and none is narrow, whatever the parcels.
TEST(CutByParcels, RandomParcelsLeaveTheBlocksAsTheyAre) {
    for (unsigned seed = 0; seed < 12; ++seed) {
        std::mt19937 random(seed);
        Town town(90, 90, {0.5, 0.5, 1});
        for (int i = 0; i < 4; ++i) {
            const auto at = [&] { return static_cast<std::int32_t>(random() % 50); };
            const std::int32_t top = at();
            const std::int32_t left = at();
            town.block(top, left, top + 24 + at() / 4, left + 24 + at() / 4,
                       106 + static_cast<float>(random() % 5));
        }
        std::vector<std::pair<double, double>> sites;
        for (int i = 0; i < 20; ++i)
            sites.emplace_back(random() % 90, random() % 90);
        const auto nearest = [&](std::int32_t r, std::int32_t c) -> std::int64_t {
            std::size_t best = 0;
            for (std::size_t i = 1; i < sites.size(); ++i)
                if (std::hypot(r - sites[i].first, c - sites[i].second) <
                    std::hypot(r - sites[best].first, c - sites[best].second))
                    best = i;
            return static_cast<std::int64_t>(best);
        };
        const Detection whole = test::detect(town);
        const Detection found = detect_cut(town, grid_of(town, nearest));
        EXPECT_EQ(drawing(test::building_mask(found)), drawing(test::building_mask(whole)));
        EXPECT_GT(found.buildings, whole.buildings);
        Context context;
        std::set<Label> seen;
        for (Label label = 1; label <= found.buildings; ++label) {
            const Mask cells = cells_with(found.labels, [&](Label other) { return other == label; });
            EXPECT_EQ(connected_regions(cells, 1, 0, *context.threads).count(), 1U);
            EXPECT_GE(found.objects[label - 1].cells, 40);  // 10 m2
        }
    }
}

}  // namespace
}  // namespace d2b

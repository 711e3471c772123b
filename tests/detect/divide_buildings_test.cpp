#include "detect/divide_buildings.hpp"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "detect_case.hpp"
#include "raster/regions.hpp"
#include "support/test_threads.hpp"

namespace d2b::detect {
namespace {

using namespace test;

DetectOptions split_at(double height) {
    DetectOptions options;
    options.split_height = height;
    return options;
}

/// Cells of one label, as a drawing.
std::vector<std::string> piece(const Detection& detection, Label label) {
    return drawing(cells_with(detection.labels, [&](Label other) { return other == label; }));
}

/// A piece of a town that is level at the elevation, without the corners of the building.
std::vector<std::string> level(const Town& town, float elevation, const Block& building) {
    Mask mask(town.surface.rows, town.surface.cols);
    for (std::size_t i = 0; i < mask.size(); ++i)
        mask.values[i] = town.surface.values[i] == elevation ? 1 : 0;
    return drawing(without_corners(std::move(mask), {building}));
}

constexpr Block podium{5, 5, 35, 45};

Town tower_on_podium() {
    Town town(40, 50);
    town.block(podium.top, podium.left, podium.bottom, podium.right, 106);
    town.block(12, 20, 24, 32, 130);
    return town;
}

TEST(Split, TowerLeavesItsPodium) {
    const Town town = tower_on_podium();
    const Detection whole = detect_in(town);
    ASSERT_EQ(whole.buildings, 1U);
    const Detection found = detect_in(town, split_at(3));
    ASSERT_EQ(found.buildings, 2U);
    EXPECT_EQ(piece(found, 1), level(town, 106, podium));
    EXPECT_EQ(piece(found, 2), level(town, 130, podium));
    EXPECT_EQ(found.objects[0].cells, 30 * 40 - 4 - 144);
    EXPECT_EQ(found.objects[1].cells, 144);
    for (const DetectedObject& object : found.objects) {
        EXPECT_EQ(object.confidence, whole.objects[0].confidence);
        EXPECT_EQ(object.doubt, whole.objects[0].doubt);
    }
}

TEST(Split, OffOrNoStepChangesNothing) {
    const Town town = tower_on_podium();
    const Detection whole = detect_in(town);
    for (const double height : {0.0, 24.0, 100.0}) {
        const Detection found = detect_in(town, split_at(height));
        EXPECT_EQ(found.labels.values, whole.labels.values) << height;
        EXPECT_EQ(found.objects.size(), 1U);
        EXPECT_EQ(found.objects[0].cells, whole.objects[0].cells);
    }
    EXPECT_EQ(detect_in(town, split_at(23.9)).buildings, 2U);
    EXPECT_EQ(detect_in(Town(10, 10), split_at(3)).buildings, 0U) << "nothing to split";
}

TEST(Split, TerraceOfThreeHeights) {
    Town town(30, 60);
    town.block(5, 5, 20, 20, 112);
    town.block(5, 20, 20, 35, 108);
    town.block(5, 35, 20, 50, 104);
    const Detection found = detect_in(town, split_at(2));
    ASSERT_EQ(found.buildings, 3U);
    const Block terrace{5, 5, 20, 50};
    EXPECT_EQ(piece(found, 1), level(town, 112, terrace));
    EXPECT_EQ(piece(found, 2), level(town, 108, terrace));
    EXPECT_EQ(piece(found, 3), level(town, 104, terrace));
}

TEST(Split, RoofsThatSlopeStayWhole) {
    Town town(30, 40);
    town.build([](auto r, auto c) {
        return r >= 5 && r < 25 && c >= 5 && c < 35 ? 115 - std::abs(static_cast<float>(r) - 14.5F) : unknown;
    });
    const Detection found = detect_in(town, split_at(1.5));
    ASSERT_EQ(found.buildings, 1U);
    EXPECT_EQ(found.labels.values, detect_in(town).labels.values);
}

TEST(Split, SpikesAndPitsAreMerged) {
    Town town = tower_on_podium();
    town.surface.at(8, 8) = 120;        // an antenna
    town.block(13, 21, 15, 24, 135);    // a plant room
    town.surface.at(28, 30) = unknown;  // a hole in the data
    const Detection found = detect_in(town, split_at(3));
    ASSERT_EQ(found.buildings, 2U);
    EXPECT_EQ(found.objects[1].cells, 144);
    EXPECT_EQ(found.labels.at(8, 8), 1U);
    EXPECT_EQ(found.labels.at(13, 21), 2U);
    EXPECT_EQ(found.labels.at(28, 30), 1U);
}

TEST(Split, SmearedWallsAreMergedThoughTheyAreLarge) {
    // Two rings of cells between tower and podium, of 148 and 140 m²: each is level, and none is a building.
    Town town(90, 90);
    town.block(5, 5, 85, 85, 106);
    town.block(25, 25, 63, 63, 114);
    town.block(26, 26, 62, 62, 122);
    town.block(27, 27, 61, 61, 130);
    const Detection found = detect_in(town, split_at(3));
    ASSERT_EQ(found.buildings, 2U);
    // The inner ring goes first: it has fewer cells, and its longer border is to the outer ring, which then
    // goes to the podium.
    EXPECT_EQ(piece(found, 2), level(town, 130, {5, 5, 85, 85}));
}

TEST(Split, DoubtfulObjectsStayWholeAndKeepTheirPlace) {
    Town town = tower_on_podium();
    Detection detection = detect_in(town);
    // The same object twice: as a building in the left half, as a doubtful one in the right half.
    for (std::int32_t r = 0; r < 40; ++r)
        for (std::int32_t c = 26; c < 50; ++c)
            detection.labels.at(r, c) *= 2;
    // Each half has lost two corners.
    detection.objects.push_back({0.25, CounterEvidence::steep, 568});
    detection.objects[0].cells = 628;
    split_buildings(town.scene(), 3, 30, detection, threads());
    EXPECT_EQ(detection.buildings, 2U);
    ASSERT_EQ(detection.objects.size(), 3U);
    EXPECT_EQ(detection.objects[0].cells, 30 * 21 - 2 - 72);
    EXPECT_EQ(detection.objects[1].cells, 72);
    EXPECT_EQ(detection.objects[2].cells, 568);
    EXPECT_EQ(detection.objects[2].doubt, CounterEvidence::steep);
    EXPECT_EQ(detection.labels.at(15, 25), 2U);
    EXPECT_EQ(detection.labels.at(15, 26), 3U);
    EXPECT_EQ(detection.labels.at(6, 44), 3U);
}

/// One building of 8 rows; its columns have these elevations.
Detection striped(const std::vector<float>& columns, std::int64_t min_cells, Town& town) {
    const auto cols = static_cast<std::int32_t>(columns.size());
    town = Town(8, cols);
    town.build([&](auto, auto c) { return columns[static_cast<std::size_t>(c)]; });
    Detection detection;
    detection.labels = Grid<Label>(8, cols, 1);
    detection.objects.push_back({0.9, CounterEvidence::rough, std::int64_t{8} * cols});
    detection.buildings = 1;
    split_buildings(town.scene(), 3, min_cells, detection, threads());
    return detection;
}

TEST(Split, EqualBordersGoToTheNearestHeightThenToTheFirst) {
    Town town(1, 1);
    const auto middle = [&](float left, float between, float right) {
        const Detection found =
            striped({left, left, left, left, between, right, right, right, right}, 9, town);
        EXPECT_EQ(found.buildings, 2U);
        return found.labels.at(0, 4);
    };
    EXPECT_EQ(middle(110, 120, 135), 1U);
    EXPECT_EQ(middle(105, 120, 125), 2U);
    EXPECT_EQ(middle(110, 120, 130), 1U);
}

TEST(Split, NarrowPiecesAllTheWayAreOneBuilding) {
    Town town(1, 1);
    const Detection found = striped({110, 120, 110, 120, 110, 120, 110, 120}, 1, town);
    EXPECT_EQ(found.buildings, 1U);
    EXPECT_EQ(found.objects[0].cells, 64);
}

TEST(Split, NoiseIsPartitionedIntoLargeConnectedPieces) {
    std::mt19937 random(8);
    for (int i = 0; i < 60; ++i) {
        Town town(40, 50, i % 2 == 0 ? CellSize{1, 1} : CellSize{2.5, 2});
        const Mask blocks = random_blocks(40, 50, 40, random);
        town.build([&](auto r, auto c) {
            return blocks.at(r, c) != 0
                       ? 110 + 5 * static_cast<float>(random() % 3) * (c / 12 % 2 == 0 ? 1 : 0)
                       : unknown;
        });
        const Regions regions = connected_regions(blocks, 1, 0, threads());
        Detection detection;
        std::vector<Label> itself(regions.cells.size());
        for (Label label = 0; label < itself.size(); ++label)
            itself[label] = label;
        detection.labels = label_grid(regions, itself, threads());
        detection.buildings = regions.count();
        for (Label label = 1; label <= regions.count(); ++label)
            detection.objects.push_back({1.0 / label, CounterEvidence::rough, regions.cells[label]});
        const Grid<Label> before = detection.labels;
        split_buildings(town.scene(), 3, 20, detection, threads());

        ASSERT_EQ(drawing(building_mask(detection)), drawing(blocks));
        ASSERT_EQ(detection.objects.size(), detection.buildings);
        Label last = 0;
        std::vector<std::int64_t> cells(detection.buildings + 1, 0);
        for (std::size_t j = 0; j < before.size(); ++j) {
            const Label label = detection.labels.values[j];
            ASSERT_LE(label, last + 1) << "numbered in scan order";
            last = std::max(last, label);
            ++cells[label];
            if (label != 0) {
                ASSERT_EQ(detection.objects[label - 1].confidence, 1.0 / before.values[j]);
            }
        }
        const Regions pieces = joined_regions(
            blocks,
            [&](std::size_t a, std::size_t b) {
                return detection.labels.values[a] == detection.labels.values[b];
            },
            threads());
        EXPECT_EQ(pieces.count(), detection.buildings) << "each piece is connected";
        for (Label label = 1; label <= detection.buildings; ++label) {
            const DetectedObject& object = detection.objects[label - 1];
            EXPECT_EQ(object.cells, cells[label]);
            const auto whole = static_cast<std::size_t>(std::lround(1 / object.confidence));
            EXPECT_TRUE(object.cells >= 20 || object.cells == regions.cells[whole]);
        }
    }
}

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
    const Detection whole = detect_in(town);
    ASSERT_EQ(whole.buildings, 1U);
    const Detection found = detect_cut(town, grid_of(town, house_of));
    ASSERT_EQ(found.buildings, 6U);
    EXPECT_EQ(drawing(building_mask(found)), drawing(building_mask(whole)));
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
    EXPECT_EQ(detect_in(town, steps).buildings, 3U);
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

/// Parts cover the building, hang together, and none is narrow, whatever the parcels.
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
        const Detection whole = detect_in(town);
        const Detection found = detect_cut(town, grid_of(town, nearest));
        EXPECT_EQ(drawing(building_mask(found)), drawing(building_mask(whole)));
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
}  // namespace d2b::detect

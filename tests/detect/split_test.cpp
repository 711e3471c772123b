#include <cmath>

#include <gtest/gtest.h>

#include "detect/divide_buildings.hpp"
#include "detect/regions.hpp"
#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

using test::building_mask;
using test::detect;
using test::drawing;
using test::Town;
using test::unknown;

DetectOptions split_at(double height) {
    DetectOptions options;
    options.split_height = height;
    return options;
}

/// Cells of one label, as a drawing.
std::vector<std::string> piece(const Detection& detection, Label label) {
    return drawing(test::cells_with(detection.labels, [&](Label other) { return other == label; }));
}

/// A piece of a town that is level at the elevation, without the corners of the building.
std::vector<std::string> level(const Town& town, float elevation, const test::Block& building) {
    Mask mask(town.surface.rows, town.surface.cols);
    for (std::size_t i = 0; i < mask.size(); ++i)
        mask.values[i] = town.surface.values[i] == elevation ? 1 : 0;
    return drawing(test::without_corners(std::move(mask), {building}));
}

constexpr test::Block podium{5, 5, 35, 45};

Town tower_on_podium() {
    Town town(40, 50);
    town.block(podium.top, podium.left, podium.bottom, podium.right, 106);
    town.block(12, 20, 24, 32, 130);
    return town;
}

TEST(Split, TowerLeavesItsPodium) {
    const Town town = tower_on_podium();
    const Detection whole = detect(town);
    ASSERT_EQ(whole.buildings, 1U);
    const Detection found = detect(town, split_at(3));
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
    const Detection whole = detect(town);
    for (const double height : {0.0, 24.0, 100.0}) {
        const Detection found = detect(town, split_at(height));
        EXPECT_EQ(found.labels.values, whole.labels.values) << height;
        EXPECT_EQ(found.objects.size(), 1U);
        EXPECT_EQ(found.objects[0].cells, whole.objects[0].cells);
    }
    EXPECT_EQ(detect(town, split_at(23.9)).buildings, 2U);
    EXPECT_EQ(detect(Town(10, 10), split_at(3)).buildings, 0U) << "nothing to split";
}

TEST(Split, TerraceOfThreeHeights) {
    Town town(30, 60);
    town.block(5, 5, 20, 20, 112);
    town.block(5, 20, 20, 35, 108);
    town.block(5, 35, 20, 50, 104);
    const Detection found = detect(town, split_at(2));
    ASSERT_EQ(found.buildings, 3U);
    const test::Block terrace{5, 5, 20, 50};
    EXPECT_EQ(piece(found, 1), level(town, 112, terrace));
    EXPECT_EQ(piece(found, 2), level(town, 108, terrace));
    EXPECT_EQ(piece(found, 3), level(town, 104, terrace));
}

TEST(Split, RoofsThatSlopeStayWhole) {
    Town town(30, 40);
    town.build([](auto r, auto c) {
        return r >= 5 && r < 25 && c >= 5 && c < 35 ? 115 - std::abs(static_cast<float>(r) - 14.5F) : unknown;
    });
    const Detection found = detect(town, split_at(1.5));
    ASSERT_EQ(found.buildings, 1U);
    EXPECT_EQ(found.labels.values, detect(town).labels.values);
}

TEST(Split, SpikesAndPitsAreMerged) {
    Town town = tower_on_podium();
    town.surface.at(8, 8) = 120;        // an antenna
    town.block(13, 21, 15, 24, 135);    // a plant room
    town.surface.at(28, 30) = unknown;  // a hole in the data
    const Detection found = detect(town, split_at(3));
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
    const Detection found = detect(town, split_at(3));
    ASSERT_EQ(found.buildings, 2U);
    // The inner ring goes first: it has fewer cells, and its longer border is to the outer ring, which then
    // goes to the podium.
    EXPECT_EQ(piece(found, 2), level(town, 130, {5, 5, 85, 85}));
}

TEST(Split, DoubtfulObjectsStayWholeAndKeepTheirPlace) {
    Town town = tower_on_podium();
    Detection detection = detect(town);
    // The same object twice: as a building in the left half, as a doubtful one in the right half.
    for (std::int32_t r = 0; r < 40; ++r)
        for (std::int32_t c = 26; c < 50; ++c)
            detection.labels.at(r, c) *= 2;
    // Each half has lost two corners.
    detection.objects.push_back({0.25, CounterEvidence::steep, 568});
    detection.objects[0].cells = 628;
    split_buildings(town.scene(), 3, 30, detection, test::threads());
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
    split_buildings(town.scene(), 3, min_cells, detection, test::threads());
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
        const Mask blocks = test::random_blocks(40, 50, 40, random);
        town.build([&](auto r, auto c) {
            return blocks.at(r, c) != 0
                       ? 110 + 5 * static_cast<float>(random() % 3) * (c / 12 % 2 == 0 ? 1 : 0)
                       : unknown;
        });
        const Regions regions = connected_regions(blocks, 1, 0, test::threads());
        Detection detection;
        std::vector<Label> itself(regions.cells.size());
        for (Label label = 0; label < itself.size(); ++label)
            itself[label] = label;
        detection.labels = label_grid(regions, itself, test::threads());
        detection.buildings = regions.count();
        for (Label label = 1; label <= regions.count(); ++label)
            detection.objects.push_back({1.0 / label, CounterEvidence::rough, regions.cells[label]});
        const Grid<Label> before = detection.labels;
        split_buildings(town.scene(), 3, 20, detection, test::threads());

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
            test::threads());
        EXPECT_EQ(pieces.count(), detection.buildings) << "each piece is connected";
        for (Label label = 1; label <= detection.buildings; ++label) {
            const DetectedObject& object = detection.objects[label - 1];
            EXPECT_EQ(object.cells, cells[label]);
            const auto whole = static_cast<std::size_t>(std::lround(1 / object.confidence));
            EXPECT_TRUE(object.cells >= 20 || object.cells == regions.cells[whole]);
        }
    }
}

}  // namespace
}  // namespace d2b

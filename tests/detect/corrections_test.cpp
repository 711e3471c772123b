#include "detect/corrections.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b::detect {
namespace {

using namespace test;

/// A house of 14 x 18 m, a low one of 10 x 20 m of which nothing is found, and between them a yard.
Town two_houses() {
    Town town(40, 60);
    town.block(5, 5, 19, 23, 107);
    town.block(5, 35, 15, 55, 101.5F);
    return town;
}

SceneCorrection area(CorrectionKind kind, const Block& box, std::size_t index = 0) {
    SceneCorrection correction{index, kind, false, {}, {}};
    for (std::int32_t row = box.top; row < box.bottom; ++row)
        correction.cells.push_back({row, box.left, box.right});
    return correction;
}

SceneCorrection point(CorrectionKind kind, std::int32_t row, std::int32_t col, std::size_t index = 0) {
    return {index, kind, true, {{row, col, col + 1}}, {}};
}

/// A line down between two columns.
SceneCorrection cut_before(std::int32_t col, std::int32_t top, std::int32_t bottom, std::size_t index = 0) {
    SceneCorrection correction{index, CorrectionKind::cut, false, {}, {}};
    for (std::int32_t row = top; row < bottom; ++row)
        correction.cuts.push_back({row, col - 1, false});
    return correction;
}

struct Corrected {
    Detection detection;
    std::vector<std::size_t> effective;
};

Corrected correct(const Town& town, const std::vector<SceneCorrection>& corrections,
                  DetectOptions options = {}) {
    Scene scene = town.scene();
    scene.corrections = corrections;
    Context context;
    Corrected result;
    result.detection = detect_buildings(scene, options, default_min_building_m2, context);
    mark_denied(scene, result.detection, threads());
    result.effective =
        effective_corrections(scene, result.detection, {0, 0, town.surface.rows, town.surface.cols});
    return result;
}

std::int64_t cells_with_label(const Detection& detection, Label label) {
    return std::ranges::count(detection.labels.values, label);
}

TEST(Corrections, APolygonMakesABuildingOfWhatRises) {
    DetectOptions options;
    options.min_confidence = 1;
    Town town = two_houses();
    // Rough as a heap, and so no sure building.
    town.build([](std::int32_t r, std::int32_t c) {
        return r >= 25 && r < 35 && c >= 35 && c < 47
                   ? 103.0F + 4.0F * static_cast<float>((r * 7 + c * 5) % 3)
                   : unknown;
    });
    const Corrected before = correct(town, {}, options);
    const Label found = before.detection.labels.at(30, 40);
    EXPECT_FALSE(before.detection.is_building(found));
    // Two columns and a row of the polygon are ground.
    const Corrected after = correct(town, {area(CorrectionKind::building, {24, 35, 35, 49}, 7)}, options);
    const Label label = after.detection.labels.at(30, 40);
    ASSERT_TRUE(after.detection.is_building(label));
    EXPECT_EQ(cells_with_label(after.detection, label), 10 * 12);
    EXPECT_EQ(after.detection.objects[label - 1].cells, 10 * 12);
    EXPECT_EQ(after.detection.objects[label - 1].confidence, 1);
    EXPECT_EQ(after.detection.buildings, before.detection.buildings + 1);
    EXPECT_EQ(after.effective, std::vector<std::size_t>{7});
}

TEST(Corrections, APolygonOverGroundHasNoEffect) {
    const Town town = two_houses();
    const Corrected before = correct(town, {});
    const Corrected after = correct(town, {area(CorrectionKind::building, {25, 5, 35, 20})});
    EXPECT_EQ(after.detection.labels.values, before.detection.labels.values);
    EXPECT_TRUE(after.effective.empty());
    // Nine cells of the house are less than the smallest building.
    const Corrected corner = correct(town, {area(CorrectionKind::building, {6, 6, 9, 9})});
    EXPECT_EQ(corner.detection.labels.values, before.detection.labels.values);
    EXPECT_TRUE(corner.effective.empty());
}

/// 10 of 18 columns of the house lie in the first polygon, and 6 in the second.
TEST(Corrections, APolygonTakesAnObjectWholeIfHalfOfItLiesInIt) {
    const Town town = two_houses();
    const Detection before = correct(town, {}).detection;
    ASSERT_EQ(before.buildings, 1U);
    const Detection half_house = correct(town, {area(CorrectionKind::building, {0, 0, 30, 15})}).detection;
    ASSERT_EQ(half_house.buildings, 1U);
    EXPECT_EQ(cells_with_label(half_house, 1),
              cells_with_label(before, 1) + 2);  // the corners that detection rounds off
    EXPECT_EQ(half_house.objects[0].confidence, 1);
    const Detection third = correct(town, {area(CorrectionKind::building, {0, 0, 30, 11})}).detection;
    ASSERT_EQ(third.buildings, 2U);
    const Label taken = third.labels.at(10, 8);
    const Label rest = third.labels.at(10, 20);
    EXPECT_NE(taken, rest);
    EXPECT_EQ(cells_with_label(third, taken) + cells_with_label(third, rest),
              cells_with_label(before, 1) + 2);
    for (std::int32_t r = 6; r < 18; ++r) {
        EXPECT_EQ(third.labels.at(r, 10), taken);
        EXPECT_EQ(third.labels.at(r, 11), rest);
    }
    EXPECT_EQ(third.objects[rest - 1].confidence, before.objects[0].confidence);
}

TEST(Corrections, APointMakesABuildingOfADoubtfulObject) {
    const Town town = two_houses();
    DetectOptions strict;
    strict.min_confidence = 1;
    Detection before = correct(town, {}, strict).detection;
    ASSERT_EQ(before.buildings, before.objects[0].confidence < 1 ? 0U : 1U);
    const Corrected after = correct(
        town, {point(CorrectionKind::building, 10, 10, 3), point(CorrectionKind::building, 30, 30, 4)},
        strict);
    EXPECT_EQ(after.detection.buildings, 1U);
    EXPECT_EQ(after.detection.objects[0].confidence, 1);
    EXPECT_EQ(after.effective, std::vector<std::size_t>{3});
}

/// The polygon takes the middle of a house, less than half of it.
TEST(Corrections, WhatAPolygonLeavesIsDividedIntoPieces) {
    const Town town = two_houses();
    const Detection before = correct(town, {}).detection;
    ASSERT_EQ(before.buildings, 1U);
    const Detection after = correct(town, {area(CorrectionKind::building, {0, 12, 30, 17})}).detection;
    EXPECT_EQ(after.buildings, 3U);
    std::int64_t sum = 0;
    for (Label label = 1; label <= after.buildings; ++label) {
        EXPECT_EQ(after.objects[label - 1].cells, cells_with_label(after, label));
        EXPECT_EQ(after.objects[label - 1].whole, label);
        sum += cells_with_label(after, label);
    }
    EXPECT_NEAR(static_cast<double>(sum), static_cast<double>(cells_with_label(before, 1)), 6);
    EXPECT_EQ(std::ranges::count(after.objects, true, &DetectedObject::confirmed), 1);
}

/// The polygon holds half of the house and one column, or half of it less one column.
TEST(Corrections, NoBuildingNeedsHalfOfTheObject) {
    const Town town = two_houses();
    const auto state = [&](const SceneCorrection& correction) {
        const Corrected result = correct(town, {correction});
        EXPECT_EQ(result.detection.buildings, 1U);
        EXPECT_EQ(result.effective.size(), result.detection.objects[0].left_out == LeftOut::denied ? 1U : 0U);
        return result.detection.objects[0].left_out;
    };
    EXPECT_EQ(state(area(CorrectionKind::no_building, {0, 0, 40, 15})), LeftOut::denied);
    EXPECT_EQ(state(area(CorrectionKind::no_building, {0, 0, 40, 13})), LeftOut::no);
    EXPECT_EQ(state(point(CorrectionKind::no_building, 10, 10)), LeftOut::denied);
    EXPECT_EQ(state(point(CorrectionKind::no_building, 25, 10)), LeftOut::no);
}

TEST(Corrections, ACutDividesABuilding) {
    const Town town = two_houses();
    const Detection before = correct(town, {}).detection;
    const Corrected after = correct(town, {cut_before(12, 0, 40, 5)});
    ASSERT_EQ(after.detection.buildings, 2U);
    EXPECT_EQ(after.effective, std::vector<std::size_t>{5});
    EXPECT_EQ(after.detection.objects[0].whole, after.detection.objects[1].whole);
    std::int64_t left = 0;
    for (std::int32_t r = 0; r < 40; ++r)
        for (std::int32_t c = 0; c < 12; ++c)
            left += before.labels.at(r, c) == 1 ? 1 : 0;
    EXPECT_EQ(cells_with_label(after.detection, after.detection.labels.at(10, 8)), left);
    EXPECT_EQ(cells_with_label(after.detection, 1) + cells_with_label(after.detection, 2),
              cells_with_label(before, 1));
}

/// One that ends in the house, one that cuts off a strip of a metre, and one in the yard.
TEST(Corrections, CutsThatDivideNothingHaveNoEffect) {
    const Town town = two_houses();
    const Corrected after =
        correct(town, {cut_before(12, 0, 12, 0), cut_before(6, 0, 40, 1), cut_before(30, 0, 40, 2)});
    EXPECT_EQ(after.detection.buildings, 1U);
    EXPECT_TRUE(after.effective.empty());
}

/// Objects that an editor has confirmed stay, and denied ones stay denied.
TEST(LeftOutObjects, AreThoseOfWhichHalfIsInTheMask) {
    Town town(40, 60);
    town.block(5, 5, 19, 23, 107);
    Mask mask(40, 60);
    for (std::int32_t r = 0; r < 40; ++r)
        for (std::int32_t c = 0; c < 14; ++c)  // nine of eighteen columns
            mask.at(r, c) = 1;
    const auto state = [&](Detection detection) {
        mark_left_out(mask, LeftOut::excluded, detection, threads());
        return detection.objects[0].left_out;
    };
    Detection found = detect_in(town);
    ASSERT_EQ(found.objects.size(), 1U);
    EXPECT_EQ(state(found), LeftOut::excluded);
    Detection confirmed = found;
    confirmed.objects[0].confirmed = true;
    EXPECT_EQ(state(confirmed), LeftOut::no);
    Detection denied = found;
    denied.objects[0].left_out = LeftOut::denied;
    EXPECT_EQ(state(denied), LeftOut::denied);
    for (std::int32_t r = 0; r < 40; ++r)
        mask.at(r, 13) = 0;
    EXPECT_EQ(state(found), LeftOut::no);
}

/// Cells beyond the core of a unit are judged by others, and the window of a scene is its own.
TEST(Corrections, AreClippedToAScene) {
    Correction whole{CorrectionKind::no_building, false, {{4, 2, 9}, {5, 2, 9}, {9, 2, 9}}, {}, "feature 1"};
    Correction line{CorrectionKind::cut, false, {}, {{4, 1, true}, {5, 6, false}}, "feature 2"};
    const std::vector<SceneCorrection> here = corrections_in({whole, line, {}}, {5, 4, 4, 3});
    ASSERT_EQ(here.size(), 2U);
    ASSERT_EQ(here[0].cells.size(), 1U);
    EXPECT_EQ(here[0].cells[0].row, 0);
    EXPECT_EQ(here[0].cells[0].begin, 0);
    EXPECT_EQ(here[0].cells[0].end, 3);
    EXPECT_EQ(here[1].index, 1U);
    ASSERT_EQ(here[1].cuts.size(), 1U);
    EXPECT_EQ(here[1].cuts[0].row, 0);
    EXPECT_EQ(here[1].cuts[0].col, 2);
}

}  // namespace
}  // namespace d2b::detect

#include "detect/object_features.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "detect/smoothness.hpp"
#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b::detect {
namespace {

using namespace test;

/// Number of the segments' cells at which its logarithm says nothing.
constexpr double even_cells = 48;
constexpr ObjectFeatures as_well_a_tree{0.4, 2.2, 0.4, even_cells, 0};

TEST(ObjectFeatures, SumsOfAHandMadeObject) {
    // A house of 3 by 4 cells, 5 m high, and one beside it of 2 by 2 that has nothing in common with it.
    const Mask cells = drawn({".........",  //
                              ".####....",  //
                              ".####.##.",  //
                              ".####.##.",  //
                              "........."});
    Town town(5, 9);
    town.block(1, 1, 4, 5, 105);
    town.block(2, 6, 4, 8, 103);
    // The step goes down to the terrain where nothing is known.
    town.surface.at(0, 2) = unknown;
    town.terrain.at(0, 2) = 90;
    Grid<std::uint8_t> flags(5, 9, smooth_along_row | smooth_along_column | smooth_any_way);
    for (const std::int32_t c : {1, 2, 3})
        flags.at(2, c) = smooth_enough;
    MetreGrid greenness(5, 9, 0.3F);  // not more than the threshold
    greenness.at(1, 1) = greenness.at(3, 4) = greenness.at(0, 0) = 0.31F;
    greenness.at(2, 2) = unknown;
    // Two pieces: one of four cells on the house and more beside it, one of two cells.
    SmoothSegments segments{connected_regions(drawn({"#........",  //
                                                     "####.....",  //
                                                     "#........",  //
                                                     ".##......",  //
                                                     "........."}),
                                              1, 0, threads()),
                            {{100, 0.48}, {20, 0.08}}};
    Scene scene = town.scene();
    scene.greenness = &greenness;
    const ObjectRegions objects{cells, connected_regions(cells, 1, 0, threads())};
    const std::vector<ObjectFeatures> features = compute_features(scene, objects, segments, flags, threads());
    ASSERT_EQ(features.size(), 2U);
    EXPECT_NEAR(features[0].smooth, 3 / 12.0, 1e-12);
    EXPECT_NEAR(features[0].green, 2 / 12.0, 1e-12);
    // Ten of the twelve cells are on the border. Three of them meet the cell that is not known.
    EXPECT_NEAR(features[0].step_m, (7 * 5 + 3 * 15) / 10.0, 1e-6);
    // Three cells on the first piece, two on the second.
    EXPECT_NEAR(features[0].tilt, std::pow(std::pow(0.5, 3) * std::pow(0.1, 2), 0.2), 1e-12);
    EXPECT_NEAR(features[0].segment, std::pow(std::pow(100.0, 3) * std::pow(20.0, 2), 0.2), 1e-9);
    EXPECT_NEAR(features[1].smooth, 0, 1e-12);
    EXPECT_NEAR(features[1].green, 0, 1e-12);
    EXPECT_NEAR(features[1].step_m, 3, 1e-6);
    EXPECT_NEAR(features[1].tilt, 1, 1e-12) << "no pieces";
    EXPECT_NEAR(features[1].segment, 1, 1e-12);
    // Cells are of 1 m.
    EXPECT_EQ(features[0].area_m2, 12);
    EXPECT_NEAR(features[0].compactness, 3 / std::numbers::pi, 1e-9) << "a rectangle";
    EXPECT_EQ(features[0].low_slope_ratio, 1);
    EXPECT_EQ(features[1].beside_m, 0);
}

TEST(ObjectFeatures, CellsAtTheRastersBorderAndUnknownCells) {
    Town town(3, 3);
    town.block(0, 0, 3, 3, 110);
    town.surface.at(1, 1) = unknown;
    const Mask cells(3, 3, 1);
    const std::vector<ObjectFeatures> features =
        compute_features(town.scene(), {cells, connected_regions(cells, 1, 0, threads())},
                         {connected_regions(Mask(3, 3), 1, 0, threads()), {}},
                         Grid<std::uint8_t>(3, 3, smooth_enough), threads());
    ASSERT_EQ(features.size(), 1U);
    // All eight other cells are on the border, and the ground in the middle is below all of them.
    EXPECT_NEAR(features[0].step_m, 10, 1e-6);
    EXPECT_NEAR(features[0].smooth, 1, 1e-12);
    EXPECT_NEAR(features[0].green, 0, 1e-12) << "no NDVI";
}

/// A slope that is taken for an object along the raster's right border, as its ground lies below.
ObjectFeatures of_a_slope(float rise, double side, const Shape& more = {}) {
    Town town(40, 60, {side, side});
    town.build([&](std::int32_t r, std::int32_t c) {
        return 100 +
               rise * static_cast<float>(side) *
                   (0.8F * static_cast<float>(c) + 0.6F * static_cast<float>(r)) +
               (more ? more(r, c) : 0.0F);
    });
    Mask cells(40, 60);
    for (std::int32_t r = 0; r < 40; ++r)
        std::fill(cells.row(r).begin() + 45, cells.row(r).end(), std::uint8_t{1});
    const Regions none = connected_regions(Mask(40, 60), 1, 0, threads());
    return compute_features(town.scene(), {cells, connected_regions(cells, 1, 0, threads())}, {none, {}},
                            Grid<std::uint8_t>(40, 60, smooth_enough), threads())
        .at(0);
}

TEST(ObjectFeatures, ASlopeHasNoWallsHoweverSteep) {
    for (const float rise : {0.6F, 1.0F, 3.0F})
        for (const double side : {0.5, 1.0, 2.5}) {
            const ObjectFeatures slope = of_a_slope(rise, side);
            EXPECT_EQ(slope.walled, 0) << rise << " " << side;
            // The steepest of eight directions is at most 22.5 degrees off.
            EXPECT_LE(slope.fall, static_cast<double>(rise) * 1.001);
            EXPECT_GE(slope.fall, static_cast<double>(rise) * 0.92);
        }
    const auto wall = [](std::int32_t, std::int32_t c) { return c >= 45 ? 3.0F : 0.0F; };
    EXPECT_EQ(of_a_slope(0.6F, 0.5, wall).walled, 1);
    EXPECT_GT(of_a_slope(0.6F, 0.5, wall).fall, 6);
    // 38 cells of the border lie inside of the raster; a wall along the upper 20 rows bends 19 of them, and
    // the one below its end.
    const auto half = [](std::int32_t r, std::int32_t c) { return c >= 45 && r < 20 ? 3.0F : 0.0F; };
    EXPECT_NEAR(of_a_slope(0.6F, 0.5, half).walled, 20 / 38.0, 1e-12);
}

TEST(ObjectFeatures, SmearedWallsAreWalls) {
    // A house of 24 x 24 m and 5 m high in cells of 0.5 m, whose walls take 8 m along a cosine.
    Town town(80, 80, {0.5, 0.5});
    town.build([](std::int32_t r, std::int32_t c) {
        const double from_middle = std::max(std::abs(r - 39.5), std::abs(c - 39.5)) / 2;
        const double share = std::clamp((16 - from_middle) / 8, 0.0, 1.0);
        return static_cast<float>(100 + 2.5 * (1 - std::cos(3.14159265 * share)));
    });
    const Detection found = detect_in(town);
    ASSERT_EQ(found.buildings, 1U);
    EXPECT_GT(found.objects[0].confidence, 0.9);
}

/// A ridge through the whole raster, in cells of 2 m.
Detection found_ridge(float height, float crest_m, float slope_of_sides) {
    Town town(60, 80, {2, 2});
    town.build([=](std::int32_t, std::int32_t c) {
        const float from_middle = 2 * std::abs(static_cast<float>(c) - 39.5F);
        return 100 + std::max(height - slope_of_sides * std::max(from_middle - crest_m / 2, 0.0F), 0.0F);
    });
    return detect_in(town);
}

TEST(ObjectFeatures, ABankIsNotABuilding) {
    const Detection hall = found_ridge(5, 60, 5);
    ASSERT_EQ(hall.buildings, 1U);
    EXPECT_GT(hall.objects[0].confidence, 0.9);
    // The cells at the border of the first bank do not bend, half-way down; those of the second bend below.
    for (const Detection& bank : {found_ridge(5, 60, 0.7F), found_ridge(4, 12, 0.6F)}) {
        EXPECT_EQ(bank.buildings, 0U);
        ASSERT_EQ(bank.objects.size(), 1U);
        EXPECT_EQ(bank.objects[0].confidence, 0);
        EXPECT_EQ(counter_evidence_name(bank.objects[0].doubt), "no step at its border");
    }
}

TEST(ObjectFeatures, WallsAreNotKnownWhereAllBorderIsTheRasters) {
    const Town town(5, 5);
    const Mask cells(5, 5, 1);
    const Regions none = connected_regions(Mask(5, 5), 1, 0, threads());
    const auto features = compute_features(town.scene(), {cells, connected_regions(cells, 1, 0, threads())},
                                           {none, {}}, Grid<std::uint8_t>(5, 5, smooth_enough), threads());
    EXPECT_EQ(features.at(0).walled, 1);
}

/// A raster of 5 m cells within a hall of 3.5 m, and one of which the hall takes all but a strip on one side.
TEST(ObjectFeatures, ALowHallThatTheRasterCutsIsABuilding) {
    for (const std::int32_t first : {0, 4}) {
        Town town(40, 40, {5, 5});
        town.build([=](std::int32_t, std::int32_t c) { return c < first ? 100.0F : 103.5F; });
        const Detection found = detect_in(town);
        ASSERT_EQ(found.buildings, 1U) << first;
        EXPECT_GT(found.objects[0].confidence, 0.9);
    }
}

TEST(Classify, PartsOfARoofAreNotJudgedByTheirRightAngles) {
    ObjectFeatures part = as_well_a_tree;
    part.smooth = 0.6;
    const double likeness = roof_score(part);
    part.right_angles = 0.9;
    EXPECT_EQ(roof_score(part), likeness);
}

TEST(Classify, SmallHousesOfThinPointsAreCompact) {
    ObjectFeatures house{0.5, 3, 0.3, 9, 0, 1};
    const auto confidence = [&](double area_m2, double compactness, double filled) {
        house.area_m2 = area_m2;
        house.compactness = compactness;
        return classify(house, filled).confidence;
    };
    EXPECT_LT(confidence(75, 0.8, 0.2), confidence(75, 0.95, 0.2));
    EXPECT_EQ(confidence(75, 1, 0.2), confidence(75, 3 / std::numbers::pi, 0.2)) << "round";
    EXPECT_EQ(confidence(75, 0.5, 0), confidence(75, 0.95, 0)) << "where points are dense it says nothing";
    EXPECT_LT(confidence(225, 0.95, 0.2) - confidence(225, 0.8, 0.2),
              confidence(75, 0.95, 0.2) - confidence(75, 0.8, 0.2));
    EXPECT_EQ(confidence(300, 0.5, 0.2), confidence(300, 0.95, 0.2));
    house.low_slope_ratio = 0.9;
    house.right_angles = 0.5;
    EXPECT_GT(confidence(75, 0.95, 0.2), confidence(75, 0.5, 0.2));
    house.compactness = 0.5;
    EXPECT_EQ(counter_evidence_name(classify(house, 0.2).doubt), "ragged form");
    // Weights of sparse points take over as cells are filled.
    EXPECT_LT(confidence(75, 0.95, 0), confidence(75, 0.95, 0.05));
    EXPECT_LT(confidence(75, 0.95, 0.05), confidence(75, 0.95, 0.2));
}

TEST(Classify, AmongCrownsNothingThinIsABuilding) {
    // A piece of a forest: as the house above, but for the trees beside it.
    ObjectFeatures crown{0.5, 3, 0.3, 9, 0, 0.9};
    crown.beside_m = 9;
    crown.right_angles = 0.2;
    crown.area_m2 = 150;
    crown.low_slope_ratio = 0.4;
    EXPECT_LT(classify(crown, 0.2).confidence, 0.1);
    EXPECT_EQ(classify(crown, 0.2).doubt, CounterEvidence::rough);
    // A wood is no likelier to be a house for being large.
    ObjectFeatures wood = crown;
    wood.area_m2 = 3000;
    ObjectFeatures grove = crown;
    grove.area_m2 = 300;
    EXPECT_EQ(classify(wood, 0.2).confidence, classify(grove, 0.2).confidence);
}

TEST(Classify, Monotone) {
    double smooth = 0;
    double step = 0;
    double segment = 0;
    double tilt = 1;
    double green = 1;
    double right_angles = 0;
    for (int i = 1; i <= 20; ++i) {
        const auto next = [](double& before, const ObjectFeatures& features, bool rises) {
            const double now = classify(features).confidence;
            EXPECT_GT(now, 0);
            EXPECT_LT(now, 1);
            EXPECT_EQ(now > before, rises);
            EXPECT_NE(now, before);
            before = now;
        };
        ObjectFeatures features = as_well_a_tree;
        features.smooth = i / 20.0;
        next(smooth, features, true);
        features = as_well_a_tree;
        features.step_m = i;
        next(step, features, true);
        features = as_well_a_tree;
        features.segment = 10.0 * i;
        next(segment, features, true);
        features = as_well_a_tree;
        features.tilt = i / 10.0;
        next(tilt, features, false);
        features = as_well_a_tree;
        features.green = i / 20.0;
        next(green, features, false);
        features = as_well_a_tree;
        features.right_angles = i / 20.0;
        next(right_angles, features, true);
    }
}

TEST(Classify, NamesTheWorstTerm) {
    const auto doubt = [](const ObjectFeatures& features) {
        return counter_evidence_name(classify(features).doubt);
    };
    EXPECT_EQ(doubt({0.1, 2.2, 0.4, even_cells, 0}), "rough surface");
    EXPECT_EQ(doubt({0.4, 0.2, 0.4, even_cells, 0}), "no step at its border");
    EXPECT_EQ(doubt({0.4, 2.2, 3.0, even_cells, 0}), "steep");
    EXPECT_EQ(doubt({0.4, 2.2, 0.4, 9, 0}), "small pieces");
    EXPECT_EQ(doubt({0.4, 2.2, 0.4, even_cells, 1}), "green");
    EXPECT_EQ(classify({0.4, 2.2, 0.4, even_cells, 1}).doubt, CounterEvidence::green);
    ObjectFeatures round = as_well_a_tree;
    round.right_angles = 0.1;
    EXPECT_EQ(doubt(round), "no right angles");
}

TEST(Classify, WhatIsNotGreenIsNotDoubtedForIt) {
    // All terms speak for it, the tilt least.
    ObjectFeatures roof{0.9, 8, 0.35, 4 * even_cells, 0};
    roof.right_angles = 0.7;
    EXPECT_EQ(classify(roof).doubt, CounterEvidence::steep);
    roof.green = 0.01;
    EXPECT_EQ(classify(roof).doubt, CounterEvidence::green);
}

TEST(Classify, WithoutWallsNothingIsABuilding) {
    const ObjectFeatures roof{1, 8, 0.1, 5000, 0, 0.1};
    ObjectFeatures slope = roof;
    slope.walled = 0.09;
    EXPECT_GT(classify(roof).confidence, 0.99);
    EXPECT_EQ(classify(slope).confidence, 0);
    EXPECT_EQ(classify(slope).doubt, CounterEvidence::no_step);
    slope.tilt = 0.6;
    slope.fall = 0.6;
    EXPECT_EQ(classify(slope).confidence, 0);
    slope.fall = 2.4;  // 6 m, smeared over 2.5
    EXPECT_GT(classify(slope).confidence, 0.9);
}

BorderSums sums_of(const Town& town, const Mask& objects) {
    BorderSums sums;
    for (std::int32_t r = 0; r < objects.rows; ++r)
        for (std::int32_t c = 0; c < objects.cols; ++c)
            if (objects.at(r, c) != 0)
                sums.add(town.scene(), objects, r, c);
    return sums;
}

TEST(BorderSums, HeightOfWhatStandsBeside) {
    // One cell of an object, with a hedge of 3 m on one of the 24 cells within two cells of it, another
    // object on a second, an unknown one and one below the ground. Cells three cells away do not count.
    Town town(7, 7);
    town.block(3, 3, 4, 4, 106);
    town.surface.at(1, 5) = 103;
    town.surface.at(3, 4) = 120;
    town.surface.at(5, 1) = unknown;
    town.surface.at(2, 2) = 99;
    town.surface.at(0, 3) = 150;
    Mask objects(7, 7);
    objects.at(3, 3) = objects.at(3, 4) = 1;
    BorderSums sums;
    sums.add(town.scene(), objects, 3, 3);
    EXPECT_NEAR(sums.height_beside(), 3 / 22.0, 1e-9);
    EXPECT_EQ(BorderSums().height_beside(), 0);
}

TEST(BorderSums, RightAnglesAreThoseOfTheRasterOrTurned) {
    // A ramp along the rows, one along the columns and one along both: each alone keeps to one direction.
    for (const auto& [across, down] : {std::pair(1.0F, 0.0F), std::pair(0.0F, 1.0F), std::pair(1.0F, 2.0F)}) {
        Town town(5, 5);
        town.build([x = across, y = down](std::int32_t r, std::int32_t c) {
            return 100 + x * static_cast<float>(c) + y * static_cast<float>(r);
        });
        BorderSums sums;
        sums.add(town.scene(), Mask(5, 5, 1), 2, 2);
        EXPECT_NEAR(sums.right_angles(), 1, 1e-9);
    }
}

TEST(BorderSums, APyramidKeepsToRightAnglesAndAConeToNone) {
    const auto right_angles = [](const Shape& height) {
        Town town(41, 41);
        town.build(height);
        Mask ring(41, 41);
        for (std::int32_t r = 0; r < 41; ++r)
            for (std::int32_t c = 0; c < 41; ++c) {
                const double from_middle = std::hypot(r - 20, c - 20);
                ring.at(r, c) = from_middle > 12 && from_middle < 16 ? 1 : 0;
            }
        return sums_of(town, ring).right_angles();
    };
    EXPECT_GT(right_angles([](std::int32_t r, std::int32_t c) {
                  return 140 - static_cast<float>(std::max(std::abs(r - 20), std::abs(c - 20)));
              }),
              0.9);
    EXPECT_LT(right_angles([](std::int32_t r, std::int32_t c) {
                  return 140 - static_cast<float>(std::hypot(r - 20, c - 20));
              }),
              0.1);
}

TEST(BorderSums, ALevelSurfaceOrTheRastersBorderHasNoAngles) {
    Town town(3, 3);
    BorderSums sums;
    sums.add(town.scene(), Mask(3, 3, 1), 1, 1);
    EXPECT_EQ(sums.right_angles(), 0);
    town.surface.at(1, 1) = 110;
    sums.add(town.scene(), Mask(3, 3, 1), 0, 1);
    EXPECT_EQ(sums.right_angles(), 0);
}

double compactness_of(const Mask& object) {
    ShapeMoments sums;
    const Regions regions = connected_regions(object, 1, 0, threads());
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r))
            sums.add(r, run);
    return sums.compactness();
}

TEST(ShapeMoments, RectanglesAreAllAlike) {
    // The variance of a side is its square by twelve, so the ellipse has pi / 3 times the area.
    for (const Mask& object : {Mask(1, 1, 1), Mask(3, 3, 1), Mask(2, 40, 1), Mask(25, 1, 1)})
        EXPECT_NEAR(compactness_of(object), 3 / std::numbers::pi, 1e-9) << object.rows << " " << object.cols;
}

TEST(ShapeMoments, OfAnAngleOfThreeCells) {
    // Variances are 2 / 9 and a cell's own 1 / 12, the covariance is 1 / 9.
    const double spread = std::pow(11.0 / 36, 2) - 1.0 / 81;
    const double expected = 3 / (4 * std::numbers::pi * std::sqrt(spread));
    EXPECT_NEAR(compactness_of(drawn({"#.", "##"})), expected, 1e-12);
    EXPECT_NEAR(compactness_of(drawn({"....", "..##", "...#"})), expected, 1e-12);
    EXPECT_NEAR(compactness_of(drawn({".#", "##"})), expected, 1e-12) << "what lies left of the first";
}

TEST(ShapeMoments, ADiskIsAnEllipse) {
    Mask disk(41, 41);
    for (std::int32_t r = 0; r < 41; ++r)
        for (std::int32_t c = 0; c < 41; ++c)
            disk.at(r, c) = std::hypot(r - 20, c - 20) < 20 ? 1 : 0;
    EXPECT_NEAR(compactness_of(disk), 1, 0.005);
}

TEST(ShapeMoments, ArmsMakeItLess) {
    EXPECT_LT(compactness_of(drawn({"#####", "#....", "#....", "#...."})), 0.7);
    EXPECT_EQ(ShapeMoments().compactness(), 1);
}

double share_of(const Town& town, const Mask& objects) {
    LowSlopePairs pairs;
    const Regions regions = connected_regions(objects, 1, 0, threads());
    for (std::int32_t r = 0; r < regions.rows; ++r)
        for (const RegionRun& run : regions.row(r))
            pairs.add(town.scene(), objects, r, run);
    return pairs.share();
}

TEST(LowSlopePairs, SlopesOfNeighboursWithin) {
    // Six cells have seven pairs: three to the right of which one rises by 2 m, two of four further down.
    Town town(4, 4, {2, 4});
    town.block(1, 1, 3, 4, 105);
    town.surface.at(1, 3) = 107;
    town.surface.at(2, 1) = 107;
    const Mask objects = drawn({"....", ".###", ".###", "...."});
    // Across 2 m is too much for cells of 2 m, down it is not for cells of 4 m.
    EXPECT_NEAR(share_of(town, objects), 5 / 7.0, 1e-12);
    // At the very slope, and just below.
    town.build([](std::int32_t, std::int32_t c) { return 100 + 1.125F * static_cast<float>(c); });
    EXPECT_NEAR(share_of(town, objects), 3 / 7.0, 1e-12);
    town.build([](std::int32_t, std::int32_t c) { return 100 + 1.0625F * static_cast<float>(c); });
    EXPECT_EQ(share_of(town, objects), 1);
}

TEST(LowSlopePairs, WhatIsNotKnownIsNearToNothing) {
    Town town(1, 3);
    town.surface.at(0, 1) = unknown;
    EXPECT_EQ(share_of(town, Mask(1, 3, 1)), 0);
    EXPECT_EQ(share_of(town, drawn({"#.#"})), 1) << "no pairs";
}

TEST(LowSlopePairs, AtTheRastersBorder) {
    Town town(2, 2);
    town.surface.at(1, 1) = 150;
    EXPECT_EQ(share_of(town, Mask(2, 2, 1)), 0.5);
}

}  // namespace
}  // namespace d2b::detect

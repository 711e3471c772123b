#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "detect/object_features.hpp"
#include "detect/smoothness.hpp"
#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

using test::drawn;
using test::Shape;

/// Where the logarithm of the segments' cells says nothing.
constexpr double even_cells = 48;
constexpr ObjectFeatures as_well_a_tree{0.4, 2.2, 0.4, even_cells, 0};

TEST(ObjectFeatures, SumsOfAHandMadeObject) {
    // A house of 3 by 4 cells, 5 m high, and one beside it of 2 by 2 that has nothing in common with it.
    const Mask cells = drawn({".........",  //
                              ".####....",  //
                              ".####.##.",  //
                              ".####.##.",  //
                              "........."});
    test::Town town(5, 9);
    town.block(1, 1, 4, 5, 105);
    town.block(2, 6, 4, 8, 103);
    // Where nothing is known, the step goes down to the terrain.
    town.surface.at(0, 2) = test::unknown;
    town.terrain.at(0, 2) = 90;
    Grid<std::uint8_t> flags(5, 9, smooth_along_row | smooth_along_column | smooth_any_way);
    for (const std::int32_t c : {1, 2, 3})
        flags.at(2, c) = smooth_enough;
    MetreGrid greenness(5, 9, 0.3F);  // not more than the threshold
    greenness.at(1, 1) = greenness.at(3, 4) = greenness.at(0, 0) = 0.31F;
    greenness.at(2, 2) = test::unknown;
    // Two pieces: one of four cells on the house and more beside it, one of two cells.
    SmoothSegments segments{connected_regions(drawn({"#........",  //
                                                     "####.....",  //
                                                     "#........",  //
                                                     ".##......",  //
                                                     "........."}),
                                              1, 0, test::threads()),
                            {{100, 0.48}, {20, 0.08}}};
    Scene scene = town.scene();
    scene.greenness = &greenness;
    const ObjectRegions objects{cells, connected_regions(cells, 1, 0, test::threads())};
    const std::vector<ObjectFeatures> features =
        compute_features(scene, objects, segments, flags, test::threads());
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
    test::Town town(3, 3);
    town.block(0, 0, 3, 3, 110);
    town.surface.at(1, 1) = test::unknown;
    const Mask cells(3, 3, 1);
    const std::vector<ObjectFeatures> features =
        compute_features(town.scene(), {cells, connected_regions(cells, 1, 0, test::threads())},
                         {connected_regions(Mask(3, 3), 1, 0, test::threads()), {}},
                         Grid<std::uint8_t>(3, 3, smooth_enough), test::threads());
    ASSERT_EQ(features.size(), 1U);
    // All eight other cells are on the border, and the ground in the middle is below all of them.
    EXPECT_NEAR(features[0].step_m, 10, 1e-6);
    EXPECT_NEAR(features[0].smooth, 1, 1e-12);
    EXPECT_NEAR(features[0].green, 0, 1e-12) << "no NDVI";
}

/// A slope that is taken for an object along the raster's right border, as its ground lies below.
ObjectFeatures of_a_slope(float rise, double side, const Shape& more = {}) {
    test::Town town(40, 60, {side, side});
    town.build([&](std::int32_t r, std::int32_t c) {
        return 100 +
               rise * static_cast<float>(side) *
                   (0.8F * static_cast<float>(c) + 0.6F * static_cast<float>(r)) +
               (more ? more(r, c) : 0.0F);
    });
    Mask cells(40, 60);
    for (std::int32_t r = 0; r < 40; ++r)
        std::fill(cells.row(r).begin() + 45, cells.row(r).end(), std::uint8_t{1});
    const Regions none = connected_regions(Mask(40, 60), 1, 0, test::threads());
    return compute_features(town.scene(), {cells, connected_regions(cells, 1, 0, test::threads())},
                            {none, {}}, Grid<std::uint8_t>(40, 60, smooth_enough), test::threads())
        .at(0);
}

TEST(ObjectFeatures, ASlopeHasNoWallsHoweverSteep) {
    for (const float rise : {0.6F, 1.0F, 3.0F})
        for (const double side : {0.5, 1.0, 2.5}) {
            const ObjectFeatures slope = of_a_slope(rise, side);
            EXPECT_EQ(slope.walled, 0) << rise << " " << side;
            // Of eight directions the steepest is at most 22.5 degrees off.
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
    test::Town town(80, 80, {0.5, 0.5});
    town.build([](std::int32_t r, std::int32_t c) {
        const double from_middle = std::max(std::abs(r - 39.5), std::abs(c - 39.5)) / 2;
        const double share = std::clamp((16 - from_middle) / 8, 0.0, 1.0);
        return static_cast<float>(100 + 2.5 * (1 - std::cos(3.14159265 * share)));
    });
    const Detection found = test::detect(town);
    ASSERT_EQ(found.buildings, 1U);
    EXPECT_GT(found.objects[0].confidence, 0.9);
}

TEST(ObjectFeatures, WallsAreNotKnownWhereAllBorderIsTheRasters) {
    const test::Town town(5, 5);
    const Mask cells(5, 5, 1);
    const Regions none = connected_regions(Mask(5, 5), 1, 0, test::threads());
    const auto features =
        compute_features(town.scene(), {cells, connected_regions(cells, 1, 0, test::threads())}, {none, {}},
                         Grid<std::uint8_t>(5, 5, smooth_enough), test::threads());
    EXPECT_EQ(features.at(0).walled, 1);
}

TEST(Judge, NoTermNoOpinion) {
    EXPECT_NEAR(classify(as_well_a_tree).confidence, 0.5, 1e-12);
}

TEST(Judge, EachTermCounts) {
    const auto log_odds = [](const ObjectFeatures& features) {
        const double p = classify(features).confidence;
        return std::log(p / (1 - p));
    };
    ObjectFeatures features = as_well_a_tree;
    features.smooth = 0.9;
    EXPECT_NEAR(log_odds(features), 4.3 * 0.5, 1e-9);
    features = as_well_a_tree;
    features.green = 0.25;
    EXPECT_NEAR(log_odds(features), -1, 1e-9);
    features = as_well_a_tree;
    features.step_m = 2.2 * std::exp(1);
    EXPECT_NEAR(log_odds(features), 1.3, 1e-9);
    features.step_m = -3;
    EXPECT_NEAR(log_odds(features), 1.3 * std::log(0.1 / 2.2), 1e-9) << "no less than at 0.1 m";
    features = as_well_a_tree;
    features.tilt = 0.4 * std::exp(-1);
    EXPECT_NEAR(log_odds(features), 0.4, 1e-9);
    features = as_well_a_tree;
    features.segment = even_cells * std::exp(2);
    EXPECT_NEAR(log_odds(features), 2, 1e-9);
    features.segment = 0;
    EXPECT_NEAR(log_odds(features), -std::log(even_cells), 1e-9) << "no less than with one cell";
    features = as_well_a_tree;
    features.right_angles = 0.7;
    EXPECT_NEAR(log_odds(features), 1, 1e-9);
}

TEST(Judge, PartsOfARoofAreNotJudgedByTheirRightAngles) {
    ObjectFeatures part = as_well_a_tree;
    part.smooth = 0.6;
    const double likeness = roof_score(part);
    part.right_angles = 0.9;
    EXPECT_EQ(roof_score(part), likeness);
}

TEST(Judge, WeightsOfThinPointsTakeOverAsCellsAreFilled) {
    // A house of 12 cells of 2.5 m: few of its cells are smooth, and its segments are small.
    ObjectFeatures house{0.5, 3, 0.3, 9, 0, 1};
    house.beside_m = 0.8;
    house.right_angles = 0.5;
    house.area_m2 = 75;
    house.low_slope_ratio = 0.9;
    const auto log_odds = [&](double filled) {
        const double p = classify(house, filled).confidence;
        return std::log(p / (1 - p));
    };
    const double usual = 4.3 * 0.1 + 1.3 * std::log(3 / 2.2) - 0.4 * std::log(0.3 / 0.4) +
                         std::log(9 / 48.0) + 2.5 * (0.5 - 0.3);
    const double thin = -0.89 + 1.04 * (std::log(9) - 2.61) + 10.16 * (1 - 0.99) -
                        0.5 * (std::log(1.3) - 1.34) + 1.68 * (std::log(75) - 5.01) + 3.47 * (0.5 - 0.33) +
                        8.5 * (0.9 - 0.59);
    EXPECT_LT(usual, 0);
    EXPECT_GT(thin, usual + 0.5);
    EXPECT_NEAR(log_odds(0), usual, 1e-9);
    EXPECT_NEAR(log_odds(0.04), usual, 1e-9);
    EXPECT_NEAR(log_odds(0.05), 0.75 * usual + 0.25 * thin, 1e-9);
    EXPECT_NEAR(log_odds(0.08), thin, 1e-9);
    EXPECT_NEAR(log_odds(1), thin, 1e-9);
}

TEST(Judge, SmallHousesOfThinPointsAreCompact) {
    ObjectFeatures house{0.5, 3, 0.3, 9, 0, 1};
    house.area_m2 = 75;
    const auto log_odds = [&](double compactness, double filled) {
        ObjectFeatures formed = house;
        formed.compactness = compactness;
        const double p = classify(formed, filled).confidence;
        return std::log(p / (1 - p));
    };
    const double even = log_odds(0.905, 0.2);
    EXPECT_NEAR(log_odds(0.8, 0.2) - even, 3 * std::log(0.8 / 0.905), 1e-9);
    EXPECT_NEAR(log_odds(0.95, 0.2) - even, 3 * std::log(0.95 / 0.905), 1e-9);
    EXPECT_NEAR(log_odds(1, 0.2) - even, 3 * std::log(3 / std::numbers::pi / 0.905), 1e-9) << "round";
    EXPECT_NEAR(log_odds(0.1, 0.2) - even, -1.2, 1e-9) << "no less than this";
    EXPECT_EQ(log_odds(0.5, 0), log_odds(0.95, 0)) << "where points are dense it says nothing";
    // Half as much at 225 m2, and nothing from 300 m2 on.
    house.area_m2 = 225;
    EXPECT_NEAR(log_odds(0.8, 0.2) - log_odds(0.905, 0.2), 1.5 * std::log(0.8 / 0.905), 1e-9);
    house.area_m2 = 300;
    EXPECT_EQ(log_odds(0.5, 0.2), log_odds(0.905, 0.2));
    house.area_m2 = 75;
    house.low_slope_ratio = 0.9;
    house.right_angles = 0.5;
    house.compactness = 0.5;
    EXPECT_EQ(counter_evidence_name(classify(house, 0.2).doubt), "ragged form");
}

TEST(Judge, AmongCrownsNothingThinIsABuilding) {
    // A piece of a forest: as the house above, but for what stands beside it.
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

TEST(Judge, Monotone) {
    double smooth = 0;
    double step = 0;
    double segment = 0;
    double tilt = 1;
    double green = 1;
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
    }
}

TEST(Judge, NamesTheWorstTerm) {
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

TEST(Judge, WhatIsNotGreenIsNotDoubtedForIt) {
    // All terms speak for it, the tilt least.
    ObjectFeatures roof{0.9, 8, 0.35, 4 * even_cells, 0};
    roof.right_angles = 0.7;
    EXPECT_EQ(classify(roof).doubt, CounterEvidence::steep);
    roof.green = 0.01;
    EXPECT_EQ(classify(roof).doubt, CounterEvidence::green);
}

TEST(Judge, WithoutWallsNothingIsABuilding) {
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

}  // namespace
}  // namespace d2b

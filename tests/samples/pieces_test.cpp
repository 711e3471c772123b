// The parts of which scenes are made.
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "draft.hpp"
#include "random.hpp"
#include "render.hpp"
#include "samples.hpp"
#include "street_grid.hpp"
#include "town_plan.hpp"

namespace d2b::sample {
namespace {

TEST(Pieces, StreamIsSplitmix64) {
    // The published first numbers for seed 0.
    Random random(0);
    EXPECT_EQ(random.next(), 0xe220a8397b1dcdafU);
    EXPECT_EQ(random.next(), 0x6e789e6aa1b965f4U);
    EXPECT_EQ(random.next(), 0x06c45d188009454fU);
}

TEST(Pieces, NoiseHasMeanZeroAndVarianceOne) {
    double sum = 0;
    double squares = 0;
    double largest = 0;
    for (int i = 0; i < 200; ++i) {
        for (int j = 0; j < 200; ++j) {
            const double value = normal_at(3, i, j);
            sum += value;
            squares += value * value;
            largest = std::max(largest, std::abs(value));
        }
    }
    EXPECT_NEAR(sum / 40000, 0, 0.02);  // four standard errors
    EXPECT_NEAR(squares / 40000, 1, 0.03);
    EXPECT_LT(largest, 2 * std::sqrt(3.0));
}

TEST(Pieces, RoofsRiseAsDrawn) {
    const Rect rect{0, 0, 20, 10};
    const auto height = [&](Roof roof, double x, double y) {
        return roof_height({rect, roof, 6, 10, true}, {x, y});
    };
    EXPECT_DOUBLE_EQ(roof_height({rect, Roof::flat, 6, 6, true}, {3, 3}), 6);
    EXPECT_DOUBLE_EQ(height(Roof::gabled, 1, 5), 10);
    EXPECT_DOUBLE_EQ(height(Roof::gabled, 1, 2.5), 8);
    EXPECT_DOUBLE_EQ(height(Roof::gabled, 1, 7.5), 8);
    EXPECT_DOUBLE_EQ(height(Roof::hipped, 2.5, 5), 8);
    EXPECT_DOUBLE_EQ(height(Roof::hipped, 10, 5), 10);
    EXPECT_DOUBLE_EQ(height(Roof::shed, 17, 2.5), 7);
    EXPECT_DOUBLE_EQ(roof_height({rect, Roof::gabled, 6, 10, false}, {5, 1}), 8);
    const Rect square{0, 0, 10, 10};
    EXPECT_DOUBLE_EQ(roof_height({square, Roof::cone, 6, 10, true}, {5, 5}), 10);
    EXPECT_DOUBLE_EQ(roof_height({square, Roof::cone, 6, 10, true}, {7.5, 5}), 8);
    EXPECT_DOUBLE_EQ(roof_height({square, Roof::dome, 6, 10, true}, {8, 5}), 6 + 4 * 0.8);
}

double area(const WorldRing& ring) {
    double twice = 0;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
        twice += ring[j].x * ring[i].y - ring[i].x * ring[j].y;
    return twice / 2;
}

TEST(Pieces, OutlinesHaveTheirAreas) {
    const Rect box{0, 0, 30, 20};
    EXPECT_DOUBLE_EQ(area(l_house("", box, 5, {}).outline.exterior), 30 * 5 + 5 * 15);
    EXPECT_DOUBLE_EQ(area(u_house("", box, 5, {}).outline.exterior), 30 * 5 + 2 * 5 * 15);
    EXPECT_DOUBLE_EQ(area(h_house("", box, 5, {}).outline.exterior), 2 * 5 * 20 + 20 * 5);
    EXPECT_DOUBLE_EQ(area(court_house("", box, 5, {}).outline.interiors.at(0)), -20 * 10);
    const WorldRing ring = circle({1, 2}, 3).exterior;
    EXPECT_EQ(ring.size(), 64U);
    EXPECT_NEAR(area(ring), 32 * 9 * std::sin(2 * std::acos(-1.0) / 64), 1e-12);
}

TEST(Pieces, HousesThatTouchShareVertices) {
    std::vector<Draft> drafts{box_house("", {0, 0, 6, 10}, {}), box_house("", {6, 2, 12, 11}, {}),
                              box_house("", {20, 0, 26, 10}, {})};
    join_shared_walls(drafts);
    EXPECT_EQ(drafts[0].outline.exterior, (WorldRing{{0, 0}, {6, 0}, {6, 2}, {6, 10}, {0, 10}}));
    EXPECT_EQ(drafts[1].outline.exterior, (WorldRing{{6, 2}, {12, 2}, {12, 11}, {6, 11}, {6, 10}}));
    EXPECT_EQ(drafts[2].outline.exterior.size(), 4U);
}

TEST(Pieces, APointOnASharedWallIsInOneHouse) {
    const WorldPolygon left = rectangle({0, 0, 6, 10});
    const WorldPolygon right = rectangle({6, 0, 12, 10});
    EXPECT_NE(contains(left, {6, 3}), contains(right, {6, 3}));
    EXPECT_FALSE(contains(left, {7, 3}));
    EXPECT_TRUE(contains(right, {7, 3}));
}

TEST(Pieces, GroundIsLevelOnATerraceAndAsItWasBeyondItsBank) {
    Ground ground;
    ground.slope_x = 0.1;
    ground.level({}, {10, 0, 30, 20});
    EXPECT_DOUBLE_EQ(ground.at({11, 3}), 2);
    EXPECT_DOUBLE_EQ(ground.at({29, 19}), 2);
    EXPECT_DOUBLE_EQ(ground.at({36.5, 10}), 3.65);
    ground.creeks.push_back({{{50, -10}, {50, 30}}, 4, 14});
    EXPECT_DOUBLE_EQ(ground.at({50, 5}), 1);
    EXPECT_DOUBLE_EQ(ground.at({64, 5}), 6.4);
}

TEST(Pieces, ATreeIsNotPlantedInAHouse) {
    Scene scene;
    scene.add(box_house("", {0, 0, 10, 10}, {}), {});
    scene.plant({{5, 5}, 0, 8, 3, false, 0}, 0);
    EXPECT_TRUE(scene.trees.empty());
    scene.plant({{11, 5}, 0, 8, 3, false, 0}, 0);
    ASSERT_EQ(scene.trees.size(), 1U);
    EXPECT_FALSE(scene.trees[0].elevation_at({14.5, 5}));
    const double top = scene.trees[0].elevation_at({11, 5}).value_or(0);
    EXPECT_GE(top, 0.72 * 8);
    EXPECT_LE(top, 8);
}

TEST(Pieces, AStripOfATownIsWhatTheWholeTownHasThere) {
    const Sample whole = town();
    const std::int32_t first_row = 430;
    const std::int32_t rows = 150;
    std::vector<float> expected(150 * 1000);
    render(whole.scene, whole.raster.grid, whole.raster.unit, first_row, rows, expected);

    const TownPlan plan = town_plan();
    Scene scene = town_ground();
    build_strip(plan, 1000 - first_row - rows, 1000 - first_row, scene);
    EXPECT_LT(scene.buildings.size(), whole.scene.buildings.size());
    std::vector<float> elevations(expected.size());
    for (std::int32_t row = 0; row < rows; row += 7) {
        const std::int32_t some = std::min(7, rows - row);
        render(scene, whole.raster.grid, whole.raster.unit, first_row + row, some,
               std::span(elevations)
                   .subspan(static_cast<std::size_t>(row) * 1000, static_cast<std::size_t>(some) * 1000));
    }
    EXPECT_EQ(elevations, expected);
}

TEST(Pieces, QuartersOfALargeTownAreDrawnFromItsSeed) {
    TownPlan plan;
    plan.seed = 5;
    plan.cols = 40;
    plan.rows = 40;
    std::array<int, 6> found{};
    for (std::int32_t row = 0; row < 40; ++row) {
        for (std::int32_t col = 0; col < 40; ++col)
            ++found[static_cast<std::size_t>(plan.quarter(col, row))];
    }
    for (const int n : found)
        EXPECT_NEAR(n, 1600 / 6, 75);  // five standard deviations
    Scene scene = town_ground();
    build_quarter(plan, 30, 30, scene);
    const auto corners = plan.corners(30, 30);
    for (const Building& building : scene.buildings) {
        for (const Position& p : building.footprint.exterior)
            EXPECT_GT(left_of(corners[0], corners[1], p), 10);
    }
}

}  // namespace
}  // namespace d2b::sample

#include "detect/detection.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "detect_case.hpp"
#include "options/run_plan.hpp"
#include "support/test_threads.hpp"

namespace d2b::detect {
namespace {

using namespace test;

constexpr Block house_block{10, 12, 24, 32};

float slope(std::int32_t r, std::int32_t c) {
    return 100 + 0.12F * static_cast<float>(r) - 0.08F * static_cast<float>(c);
}

bool in_house(std::int32_t r, std::int32_t c) {
    return r >= house_block.top && r < house_block.bottom && c >= house_block.left && c < house_block.right;
}

/// A house, and its corners if it has some.
struct House {
    Shape shape;
    std::vector<Block> blocks;
};

/// Level, gabled and round houses. The round one is an octagon of cells, its border's steps go up by a cell
/// and are five to nine cells wide or a cell each: all its cells see at least five of nine.
std::vector<House> houses() {
    return {
        {[](auto r, auto c) { return in_house(r, c) ? 109.0F : unknown; }, {house_block}},
        {[](auto r, auto c) {
             return in_house(r, c) ? 112 - 0.6F * std::abs(static_cast<float>(r) - 16.5F) : unknown;
         },
         {house_block}},
        {[](auto r, auto c) { return std::hypot(r - 17, c - 20) < 9 ? 115.0F : unknown; }, {}},
    };
}

/// Crowns as a laser sees them: each cell another leaf.
void plant(Town& town, std::int32_t top, std::int32_t left, std::int32_t rows, std::int32_t cols,
           unsigned seed) {
    std::mt19937 random(seed);
    for (std::int32_t r = top; r < top + rows; ++r)
        for (std::int32_t c = left; c < left + cols; ++c)
            town.surface.at(r, c) = town.terrain.at(r, c) + 3 + static_cast<float>(random() % 900) / 100;
}

/// Houses and trees of all kinds.
Town mixed_town() {
    Town town(90, 70);
    town.block(5, 5, 20, 30, 108);
    town.block(20, 5, 32, 15, 106);
    town.build([](auto r, auto c) { return std::hypot(r - 60, c - 20) < 10 ? 118.0F : unknown; });
    town.build([](auto r, auto c) {
        return r >= 30 && r < 50 && c >= 40 && c < 60 ? 112 - 0.4F * std::abs(static_cast<float>(c) - 49.5F)
                                                      : unknown;
    });
    plant(town, 10, 35, 15, 20, 1);
    plant(town, 48, 44, 12, 22, 2);
    return town;
}

TEST(Detection, HousesAreFoundCellByCellButForTheirCorners) {
    for (const Shape& ground : {Shape(), Shape(slope)})
        for (const House& house : houses()) {
            Town town(36, 44, {}, ground);
            town.build(house.shape);
            const Mask expected = without_corners(raised(town), house.blocks);
            const Detection found = detect_in(town);
            EXPECT_EQ(found.buildings, 1U);
            ASSERT_EQ(found.objects.size(), 1U);
            EXPECT_EQ(drawing(building_mask(found)), drawing(expected));
            EXPECT_EQ(found.objects[0].cells, std::count(expected.values.begin(), expected.values.end(), 1));
            EXPECT_GT(found.objects[0].confidence, 0.9);
        }
}

TEST(Detection, SmallCellsLoseThreeACorner) {
    // 25 cells of 0.5 m vote. The corner sees 3 x 3 of them, those beside it 3 x 4: both less than half. The
    // next see 3 x 5 along the border and 4 x 4 inwards: more.
    Town town(60, 70, {0.5, 0.5});
    town.block(15, 12, 43, 52, 109);
    Mask expected = without_corners(raised(town), {{15, 12, 43, 52}});
    expected = without_corners(std::move(expected), {{16, 12, 42, 52}, {15, 13, 43, 51}});
    EXPECT_EQ(drawing(building_mask(detect_in(town))), drawing(expected));
}

TEST(Detection, RoughTreesAreNone) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        Town town(60, 60);
        plant(town, 5, 5, 50, 50, seed);
        EXPECT_EQ(detect_in(town).buildings, 0U) << seed;
    }
}

TEST(Detection, TreesBesideAHouseStayOutside) {
    Town town(40, 60);
    town.block(10, 10, 25, 30, 109);
    const Mask house = without_corners(raised(town), {{10, 10, 25, 30}});
    plant(town, 8, 34, 20, 20, 1);
    EXPECT_EQ(drawing(building_mask(detect_in(town))), drawing(house));
}

TEST(Detection, WhatIsTooTallForTreesIsABuildingHoweverRough) {
    // The same belfry at a nave's end, and a crown of it if it were lower.
    const auto cells_of_belfry = [](float base) {
        Town town(50, 70);
        town.block(15, 20, 35, 60, 120);
        plant(town, 18, 6, 14, 14, 3);
        for (std::int32_t r = 18; r < 32; ++r)
            for (std::int32_t c = 6; c < 20; ++c)
                town.surface.at(r, c) += base;
        const Mask found = building_mask(detect_in(town));
        int cells = 0;
        for (std::int32_t r = 19; r < 31; ++r)
            for (std::int32_t c = 7; c < 19; ++c)
                cells += found.at(r, c);
        return cells;
    };
    EXPECT_EQ(cells_of_belfry(50), 12 * 12);
    EXPECT_LT(cells_of_belfry(10), 12 * 12 / 2);
}

TEST(Detection, SmallAndLowOnesAreNone) {
    Town town(20, 40);
    town.block(5, 5, 10, 11, 108);   // 26 m² without its corners
    town.block(5, 15, 11, 21, 108);  // 32 m²
    town.block(5, 26, 15, 36, 102);  // 96 m², as high as the least height, not higher
    const Detection found = detect_in(town);
    ASSERT_EQ(found.buildings, 1U);
    EXPECT_EQ(found.objects[0].cells, 32);
    EXPECT_EQ(found.labels.at(7, 17), 1U);
    DetectOptions options;
    options.min_height = 1.5;
    const Detection more = detect_in(town, options, 26);
    ASSERT_EQ(more.buildings, 3U);
    EXPECT_EQ(more.objects[0].cells, 26) << "numbered in scan order";
    EXPECT_EQ(more.objects[2].cells, 96);
    EXPECT_EQ(detect_in(town, options, 26.5).objects.size(), 2U);
    EXPECT_EQ(detect_in(town, options, 97).objects.size(), 0U);
}

TEST(Detection, LooksOnlyWhereItIsAllowedTo) {
    Town town(36, 44);
    town.build(houses()[0].shape);
    for (const std::uint8_t yes : std::vector<std::uint8_t>{1, 2, 255}) {
        Mask allowed(36, 44);
        for (std::int32_t r = 0; r < 36; ++r)
            for (std::int32_t c = 0; c < 20; ++c)
                allowed.at(r, c) = yes;
        Scene scene = town.scene();
        scene.allowed = &allowed;
        Context context;
        Mask expected = raised(town);
        for (std::size_t i = 0; i < expected.size(); ++i)
            if (allowed.values[i] == 0)
                expected.values[i] = 0;
        Block part = house_block;
        part.right = 20;
        expected = without_corners(std::move(expected), {part});
        EXPECT_EQ(drawing(building_mask(detect_buildings(scene, {}, default_min_building_m2, context))),
                  drawing(expected));
    }
}

TEST(Detection, GreenIsLessLikelyAndRoughGreenLeftOut) {
    Town town(36, 60);
    town.build(houses()[0].shape);
    const Mask house = without_corners(raised(town), {house_block});
    plant(town, 12, 32, 10, 4, 7);  // shrubs on the terrace behind, which hide the wall
    const Detection without = detect_in(town);
    MetreGrid greenness(36, 60, unknown);
    Scene scene = town.scene();
    scene.greenness = &greenness;
    Context context;
    const Detection not_known = detect_buildings(scene, {}, default_min_building_m2, context);
    EXPECT_EQ(not_known.labels.values, without.labels.values);
    EXPECT_EQ(not_known.objects[0].confidence, without.objects[0].confidence);
    EXPECT_EQ(without.labels.at(14, 33), 1U) << "joined to the house as dormers would be";
    for (std::int32_t r = 0; r < 36; ++r)
        for (std::int32_t c = 32; c < 60; ++c)
            greenness.at(r, c) = 0.6F;
    EXPECT_EQ(drawing(building_mask(detect_buildings(scene, {}, default_min_building_m2, context))),
              drawing(house));
    std::fill(greenness.values.begin(), greenness.values.end(), 0.6F);
    const Detection green = detect_buildings(scene, {}, default_min_building_m2, context);
    // Corners bend every way and are plants: their neighbours see five of nine and stay.
    EXPECT_EQ(drawing(building_mask(green)), drawing(house)) << "smooth: a green roof";
    EXPECT_LT(green.objects[0].confidence, without.objects[0].confidence);
    EXPECT_EQ(green.objects[0].doubt, CounterEvidence::green);
}

TEST(Detection, DoubtfulObjectsFollowBuildings) {
    Town town(30, 60);
    town.block(5, 5, 11, 11, 103);   // small and low
    town.block(5, 20, 25, 50, 115);  // large and high
    town.block(15, 5, 21, 11, 103);
    DetectOptions options;
    const Detection all = detect_in(town, options);
    ASSERT_EQ(all.buildings, 3U);
    const double small = all.objects[0].confidence;
    ASSERT_GT(all.objects[1].confidence, small);
    options.min_confidence = (small + all.objects[1].confidence) / 2;
    const Detection found = detect_in(town, options);
    EXPECT_EQ(found.buildings, 1U);
    ASSERT_EQ(found.objects.size(), 3U);
    EXPECT_EQ(found.labels.at(10, 30), 1U);
    EXPECT_EQ(found.labels.at(7, 7), 2U);
    EXPECT_EQ(found.labels.at(17, 7), 3U);
    EXPECT_EQ(found.objects[0].cells, 596);
    EXPECT_EQ(found.objects[1].cells, 32);
    EXPECT_EQ(found.objects[1].confidence, small);
}

TEST(Detection, CourtyardsStayAndSmallHolesGo) {
    Town town(60, 60);
    town.block(10, 10, 50, 50, 110);
    town.block(15, 15, 25, 25, 100);                                    // a courtyard of 100 m²
    town.block(40, 40, 43, 43, 100);                                    // a shaft of 9 m²
    Mask expected = without_corners(raised(town), {{10, 10, 50, 50}});  // those of the courtyard stay
    for (std::int32_t r = 40; r < 43; ++r)
        for (std::int32_t c = 40; c < 43; ++c)
            expected.at(r, c) = 1;
    EXPECT_EQ(drawing(building_mask(detect_in(town))), drawing(expected));
}

TEST(Detection, NothingThere) {
    EXPECT_EQ(detect_in(Town(20, 30)).objects.size(), 0U);
    EXPECT_EQ(detect_in(Town(20, 30)).labels.values, std::vector<Label>(600, 0));
    Town void_town(20, 30);
    void_town.build([](auto, auto) { return 0.0F; });
    std::fill(void_town.surface.values.begin(), void_town.surface.values.end(), unknown);
    EXPECT_EQ(detect_in(void_town).objects.size(), 0U);
    EXPECT_EQ(detect_in(Town(1, 1)).buildings, 0U);
    EXPECT_EQ(detect_in(Town(0, 0)).labels.size(), 0U);
}

TEST(Detection, EveryCellRaisedIsOneBuilding) {
    Town town(20, 30);
    town.block(0, 0, 20, 30, 110);
    const Detection found = detect_in(town);
    EXPECT_EQ(found.objects.size(), 1U);
    EXPECT_EQ(found.objects[0].cells, 600);
    EXPECT_EQ(found.objects[0].doubt, CounterEvidence::no_step);
}

TEST(Detection, DoesNotDependOnTheOrientation) {
    const Town town = mixed_town();
    const Detection found = detect_in(town);
    EXPECT_EQ(found.buildings, 3U);
    const auto turned = [&](const auto& turn) {
        Town other(1, 1);
        other.surface = turn(town.surface);
        other.terrain = turn(town.terrain);
        return detect_in(other);
    };
    const auto flip = [](const auto& grid) { return flipped(grid); };
    const auto transpose = [](const auto& grid) { return transposed(grid); };
    EXPECT_EQ(drawing(building_mask(turned(flip))), drawing(flipped(building_mask(found))));
    EXPECT_EQ(drawing(building_mask(turned(transpose))), drawing(transposed(building_mask(found))));
}

TEST(Detection, ObjectsCountTheirCells) {
    const Detection found = detect_in(mixed_town());
    std::vector<std::int64_t> cells(found.objects.size() + 1, 0);
    for (const Label label : found.labels.values)
        ++cells.at(label);
    for (std::size_t i = 0; i < found.objects.size(); ++i)
        EXPECT_EQ(found.objects[i].cells, cells[i + 1]);
}

TEST(Scene, ElevatedCellsRiseAboveTheHeight) {
    Town town(1, 5);
    town.surface.values = {102, 102.5F, unknown, 99, 104};
    EXPECT_EQ(elevated_cells(town.scene(), 2, threads()).values, (std::vector<std::uint8_t>{0, 1, 0, 0, 1}));
    const Mask allowed = drawn({"#.###"});
    Scene scene = town.scene();
    scene.allowed = &allowed;
    EXPECT_EQ(elevated_cells(scene, 2, threads()).values, (std::vector<std::uint8_t>{0, 0, 0, 0, 1}));
    scene.cell = {0.5, 2};
    EXPECT_EQ(scene.side(), 1);
    EXPECT_EQ(scene.cell_area(), 1);
    EXPECT_EQ(scene.height(1), 2.5F);
}

/// Houses with gables and steps, and trees, on level ground; some points are missing.
MetreGrid city(std::int32_t rows, std::int32_t cols) {
    std::mt19937 random(23);
    const auto below = [&](std::int32_t limit) {
        return static_cast<std::int32_t>(random() % static_cast<unsigned>(limit));
    };
    MetreGrid surface(rows, cols, 50.0F);
    for (int house = 0; house < rows * cols / 1500; ++house) {
        const std::int32_t row = below(rows), col = below(cols), depth = 6 + below(20),
                           length = 6 + below(60);
        const auto height = static_cast<float>(50 + 3 + below(12));
        for (std::int32_t i = row; i < std::min(rows, row + depth); ++i)
            for (std::int32_t j = col; j < std::min(cols, col + length); ++j)
                surface.at(i, j) = height + 0.4F * static_cast<float>(std::min(i - row, row + depth - i));
    }
    for (float& z : surface.values) {
        z += static_cast<float>(below(100)) / 800;
        if (below(12) == 0)
            z += static_cast<float>(below(9));
        if (below(90) == 0)
            z = std::nanf("");
    }
    return surface;
}

struct Case {
    double cell;
    double split_height;
};

TEST(DetectionThreads, TheirNumberDoesNotShow) {
    const MetreGrid surface = city(1100, 1700);
    const MetreGrid terrain(1100, 1700, 50.0F);
    MetreGrid ndvi(1100, 1700, 0.1F);
    for (std::size_t i = 0; i < ndvi.size(); i += 7)
        ndvi.values[i] = 0.5F;
    for (const Case& now : {Case{1, 0}, Case{0.5, 2}, Case{2.5, 0}}) {
        const Scene scene{surface, terrain, {now.cell, now.cell}, nullptr, &ndvi};
        DetectOptions options;
        options.split_height = now.split_height;
        Context one;
        const Detection expected = detect_buildings(scene, options, default_min_building_m2, one);
        EXPECT_GT(expected.buildings, 100U);
        for (const int count : {2, 5}) {
            Context context;
            context.threads = std::make_unique<Executor>(count);
            const Detection found = detect_buildings(scene, options, default_min_building_m2, context);
            EXPECT_TRUE(found.labels.values == expected.labels.values) << count;
            EXPECT_EQ(found.buildings, expected.buildings);
            EXPECT_TRUE(std::equal(
                found.objects.begin(), found.objects.end(), expected.objects.begin(), expected.objects.end(),
                [](const DetectedObject& a, const DetectedObject& b) {
                    return a.confidence == b.confidence && a.doubt == b.doubt && a.cells == b.cells;
                }));
        }
    }
}

}  // namespace
}  // namespace d2b::detect

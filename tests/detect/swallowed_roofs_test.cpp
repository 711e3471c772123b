#include "detect/swallowed_roofs.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "detect_case.hpp"
#include "ground/ground.hpp"
#include "support/test_threads.hpp"

namespace d2b::detect {
namespace {

using namespace test;

constexpr float street_level = 100;
constexpr float roof_level = 104;
constexpr Block old_house{20, 15, 40, 45};

/// Town whose terrain is its surface, so that all roofs are taken for ground.
Town swallowed(const Shape& elevation) {
    Town town(60, 60);
    town.build(elevation);
    town.terrain = town.surface;
    return town;
}
bool is_in(const Block& block, std::int32_t r, std::int32_t c) {
    return r >= block.top && r < block.bottom && c >= block.left && c < block.right;
}
Shape block_of(const Block& block, float elevation) {
    return [=](std::int32_t r, std::int32_t c) { return is_in(block, r, c) ? elevation : unknown; };
}

/// @param longest length of a piece, in m
Detection found_in(const Town& town, double longest = 50) {
    Scene scene = town.scene();
    scene.longest_swallowed = longest;
    Context context;
    return detect_buildings(scene, {}, default_min_building_m2, context);
}
Mask doubtful_mask(const Detection& detection) {
    return cells_with(detection.labels,
                      [&](Label label) { return label != 0 && !detection.is_building(label); });
}
Mask mask_of_block(const Town& town, const Block& block) {
    Mask mask(town.surface.rows, town.surface.cols);
    for (std::int32_t r = block.top; r < block.bottom; ++r)
        for (std::int32_t c = block.left; c < block.right; ++c)
            mask.at(r, c) = 1;
    return mask;
}

TEST(SwallowedRoofs, AHouseInTheTerrainIsDoubtful) {
    const Detection detection = found_in(swallowed(block_of(old_house, roof_level)));
    ASSERT_EQ(detection.objects.size(), 1U);
    EXPECT_EQ(detection.buildings, 0U);
    const Town town(60, 60);
    EXPECT_EQ(doubtful_mask(detection).values, mask_of_block(town, old_house).values);
    EXPECT_EQ(detection.objects.front().cells, 600);
    EXPECT_EQ(counter_evidence_name(detection.objects.front().doubt), "taken for ground");
}

TEST(SwallowedRoofs, ItsConfidenceIsHalfOfThatOnKnownTerrain) {
    Town known(60, 60);
    known.build(block_of(old_house, roof_level));
    const Detection sure = found_in(known);
    ASSERT_EQ(sure.buildings, 1U);
    const Detection doubted = found_in(swallowed(block_of(old_house, roof_level)));
    ASSERT_EQ(doubted.objects.size(), 1U);
    // The vote on the border takes the four corners off the building, so its form is not quite the same.
    EXPECT_NEAR(2 * doubted.objects.front().confidence, sure.objects.front().confidence, 0.01);
}

TEST(SwallowedRoofs, AGivenTerrainHasNone) {
    EXPECT_TRUE(found_in(swallowed(block_of(old_house, roof_level)), 0).objects.empty());
}

TEST(SwallowedRoofs, APieceLongerThanTheLimitIsNone) {
    EXPECT_EQ(found_in(swallowed(block_of(old_house, roof_level)), 30).objects.size(), 1U);
    EXPECT_TRUE(found_in(swallowed(block_of(old_house, roof_level)), 29).objects.empty());
}

TEST(SwallowedRoofs, AHouseBetweenHigherOnesIs) {
    // Walls on the long sides only, 60 of 100.
    const Block left{10, 0, 50, 15};
    const Block right{10, 45, 50, 60};
    const Detection detection = found_in(swallowed([&](std::int32_t r, std::int32_t c) {
        return is_in(left, r, c) || is_in(right, r, c) ? roof_level + 6
                                                       : (is_in(old_house, r, c) ? roof_level : unknown);
    }));
    const Mask found = doubtful_mask(detection);
    EXPECT_EQ(found.at(30, 30), 1);
    EXPECT_EQ(std::count(found.row(30).begin() + old_house.left, found.row(30).begin() + old_house.right, 1),
              30);
}

TEST(SwallowedRoofs, ATerraceInAHillIsNot) {
    // A wall on one long side, 30 of 100; on the others the hill is higher.
    EXPECT_TRUE(found_in(swallowed([](std::int32_t r, std::int32_t c) {
                    return is_in(old_house, r, c) ? roof_level
                                                  : (r < old_house.bottom ? roof_level + 4 : street_level);
                })).objects.empty());
}

TEST(SwallowedRoofs, AMoundWithARampIsNot) {
    EXPECT_TRUE(found_in(swallowed([](std::int32_t r, std::int32_t c) {
                    if (is_in(old_house, r, c))
                        return roof_level;
                    const bool on_ramp = r >= 28 && r < 33 && c >= old_house.right;
                    return on_ramp ? std::max(street_level,
                                              roof_level - 0.3F * static_cast<float>(c - old_house.right))
                                   : unknown;
                })).objects.empty());
}

TEST(SwallowedRoofs, AFrameOfWrongValuesIsNoWall) {
    Town town(40, 40);
    town.build([](std::int32_t r, std::int32_t c) {
        return r == 0 || c == 0 || r == 39 || c == 39 ? 0.0F : unknown;
    });
    town.terrain = town.surface;
    EXPECT_TRUE(found_in(town).objects.empty());
}

TEST(SwallowedRoofs, ALowOneIsNot) {
    EXPECT_EQ(found_in(swallowed(block_of(old_house, street_level + 2.1F))).objects.size(), 1U);
    EXPECT_TRUE(found_in(swallowed(block_of(old_house, street_level + 1.9F))).objects.empty());
}

TEST(SwallowedRoofs, AFallThatTheSlopeGoesOnToIsNoWall) {
    // A garden 1.3 m above a steep meadow: within two cells the surface falls by 2.4 m on 36 of its 84
    // sides, but only by 1.3 m more than the garden slopes.
    const Block garden{20, 12, 26, 48};
    const auto meadow = [](std::int32_t r, std::int32_t) {
        return street_level - 0.55F * static_cast<float>(r);
    };
    EXPECT_TRUE(found_in(swallowed([&](std::int32_t r, std::int32_t c) {
                             return meadow(r, c) + (is_in(garden, r, c) ? 1.3F : 0.0F);
                         }),
                         40)
                    .objects.empty());
}

TEST(SwallowedRoofs, APartOfABuildingThatTheTerrainShowsStaysApart) {
    Town town(60, 60);
    town.build(block_of(old_house, roof_level));
    const Detection whole = found_in(town);
    // The terrain passes through the right half.
    for (std::int32_t r = old_house.top; r < old_house.bottom; ++r)
        for (std::int32_t c = 30; c < old_house.right; ++c)
            town.terrain.at(r, c) = roof_level;
    const Detection without = detect_in(town);
    const Detection detection = found_in(town);
    ASSERT_EQ(whole.buildings, 1U);
    ASSERT_EQ(without.buildings, 1U);
    EXPECT_EQ(building_mask(detection).values, building_mask(without).values);
    const Mask building = building_mask(detection);
    const Mask doubtful = doubtful_mask(detection);
    EXPECT_EQ(doubtful.at(30, 40), 1);
    for (std::int32_t r = 0; r < doubtful.rows; ++r)
        for (std::int32_t c = 0; c + 1 < doubtful.cols; ++c)
            EXPECT_FALSE((building.at(r, c) == 1 && doubtful.at(r, c + 1) == 1) ||
                         (building.at(r, c) == 1 && doubtful.at(r, c) == 1));
}

/// Sets the terrain below the house.
void raise_terrain(Town& town, float elevation) {
    for (std::int32_t r = old_house.top; r < old_house.bottom; ++r)
        for (std::int32_t c = old_house.left; c < old_house.right; ++c)
            town.terrain.at(r, c) = elevation;
}

TEST(SwallowedRoofs, HalfOfItsHeightOrMoreIsBelowTheTerrain) {
    Town town = swallowed(block_of(old_house, street_level + 3));
    raise_terrain(town, street_level + 1.6F);
    EXPECT_EQ(found_in(town).objects.size(), 1U);
    raise_terrain(town, street_level + 1.4F);
    EXPECT_TRUE(found_in(town).objects.empty());
}

TEST(SwallowedRoofs, WhatItContainsIsNoLongerCountedAsLow) {
    Town town = swallowed(block_of(old_house, roof_level));
    raise_terrain(town, roof_level - 1.5F);
    EXPECT_EQ(detect_in(town).rejected.low.size(), 1U);
    const Detection detection = found_in(town);
    EXPECT_EQ(detection.objects.size(), 1U);
    EXPECT_TRUE(detection.rejected.low.empty());
}

TEST(SwallowedRoofs, TransposedAndFlippedAreTheSame) {
    // An L of coarse cells and a wall that is blurred over a cell.
    const auto shape = [](std::int32_t r, std::int32_t c) {
        const bool in = is_in({20, 15, 30, 45}, r, c) || is_in({20, 15, 45, 25}, r, c);
        const bool beside = is_in({19, 14, 31, 46}, r, c) || is_in({19, 14, 46, 26}, r, c);
        return in ? roof_level : (beside ? street_level + 1 : unknown);
    };
    for (const double side : {0.5, 1.0, 2.0}) {
        Town town(60, 60, {side, side});
        town.build(shape);
        town.terrain = town.surface;
        Town turned(60, 60, {side, side});
        turned.surface = flipped(transposed(town.surface));
        turned.terrain = turned.surface;
        const Mask found = doubtful_mask(found_in(town, 100));
        EXPECT_GT(std::ranges::count(found.values, 1), 300) << side;
        EXPECT_EQ(flipped(transposed(found)).values, doubtful_mask(found_in(turned, 100)).values) << side;
    }
}

TEST(SwallowedRoofs, ACutFartherAwayThanTheLimitChangesNothing) {
    constexpr std::int32_t core = 60;
    constexpr std::int32_t halo = 60;
    const Block hall{10, 100, 50, 160};  // longer than the limit, and cut to 20 m
    const auto shape = [&](std::int32_t r, std::int32_t c) {
        return is_in(old_house, r, c) || is_in(hall, r, c) ? roof_level : unknown;
    };
    Town whole(60, 200);
    Town cut(60, core + halo);
    for (Town* town : {&whole, &cut}) {
        town->build(shape);
        town->terrain = town->surface;
    }
    const Mask all = doubtful_mask(found_in(whole));
    const Mask part = doubtful_mask(found_in(cut));
    EXPECT_EQ(std::ranges::count(all.values, 1), 600);
    for (std::int32_t r = 0; r < all.rows; ++r)
        for (std::int32_t c = 0; c < core; ++c)
            EXPECT_EQ(all.at(r, c), part.at(r, c)) << r << ' ' << c;
}

TEST(SwallowedRoofs, AHallThatTheGroundFilterLosesOnAHillIsFound) {
    // The hill leads up to 0.7 m below the roof, which is less than half a wall, and the hall is walled on
    // the other sides.
    const Block hall{50, 40, 74, 80};
    const auto hill = [](std::int32_t r, std::int32_t) { return 130 - 0.2F * static_cast<float>(r); };
    Town town(120, 120, {1, 1}, hill);
    town.build(block_of(hall, hill(hall.top - 1, 0) + 0.7F));
    Context context;
    town.terrain = ground::estimate_ground(town.surface, town.cell, {}, context).elevation;
    EXPECT_NEAR(town.terrain.at(60, 60), town.surface.at(60, 60), 0.01F) << "the filter finds it";
    EXPECT_EQ(detect_in(town).objects.size(), 0U);
    const Detection detection = found_in(town, 2 * GroundOptions{}.max_building_width);
    ASSERT_EQ(detection.objects.size(), 1U);
    EXPECT_EQ(detection.buildings, 0U);
    EXPECT_EQ(doubtful_mask(detection).values, mask_of_block(town, hall).values);
}

}  // namespace
}  // namespace d2b::detect

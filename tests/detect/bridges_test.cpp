#include "detect/bridges.hpp"

#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "detect_case.hpp"
#include "support/test_threads.hpp"

namespace d2b::detect {
namespace {

using namespace test;

constexpr double usual_confidence = 0.9;
constexpr float street = 100;

/// Objects higher than 2 m, with one confidence before bridges are doubted.
std::vector<DetectedObject> objects_in(const Town& town) {
    Mask high(town.surface.rows, town.surface.cols);
    for (std::size_t i = 0; i < high.size(); ++i)
        high.values[i] = town.surface.values[i] - town.terrain.values[i] > 2 ? 1 : 0;
    const Regions regions = connected_regions(high, 1, 0, threads());
    std::vector<DetectedObject> objects(regions.count(), DetectedObject{.confidence = usual_confidence});
    doubt_bridges(town.scene(), regions, objects, threads());
    return objects;
}

/// True if the only object is a bridge, also when rows and columns are exchanged.
bool is_bridge(const Town& town) {
    Town turned(town.surface.cols, town.surface.rows, {town.cell.across, town.cell.down});
    turned.surface = transposed(town.surface);
    turned.terrain = transposed(town.terrain);
    bool both = true;
    bool either = false;
    for (const Town& scene : {town, turned}) {
        const std::vector<DetectedObject> objects = objects_in(scene);
        EXPECT_EQ(objects.size(), 1U);
        const bool is_found = counter_evidence_name(objects.front().doubt) == "bridge";
        EXPECT_EQ(objects.front().confidence, is_found ? 0.05 : usual_confidence);
        both = both && is_found;
        either = either || is_found;
    }
    EXPECT_EQ(both, either);
    return both;
}

/// Valley of 60 m, 8 m deep.
float valley(std::int32_t /*row*/, std::int32_t col) {
    const float from_middle = std::abs(static_cast<float>(col) - 45);
    return from_middle < 30 ? street - 8 * (1 - from_middle / 30) : street;
}

TEST(Bridges, ADeckToWhichTheTerrainRisesIsOne) {
    Town town(40, 90, {1, 1}, valley);
    town.block(18, 5, 22, 85, street + 1);
    EXPECT_TRUE(is_bridge(town));
}

TEST(Bridges, AWideOneIsNot) {
    Town town(40, 90, {1, 1}, valley);
    town.block(10, 5, 30, 85, street + 1);
    EXPECT_FALSE(is_bridge(town));
}

TEST(Bridges, AShortOneIsNot) {
    Town town(40, 90, {0.5, 0.5}, valley);
    town.block(18, 5, 22, 85, street + 1);
    EXPECT_FALSE(is_bridge(town));
}

TEST(Bridges, ABentOneIs) {
    Town town(60, 90, {1, 1}, valley);
    // 29 m down at a bend of 45 degrees: the ends are 0.9 of the length apart.
    town.build([](std::int32_t r, std::int32_t c) {
        const std::int32_t middle = c < 45 ? 15 : 15 + (c - 45);
        return c >= 5 && c < 85 && std::abs(r - middle) <= 2 ? street + 1 : unknown;
    });
    EXPECT_TRUE(is_bridge(town));
}

TEST(Bridges, ARowOfHousesWithLowEndsIsNot) {
    Town town(40, 90);
    town.block(16, 15, 24, 75, street + 6);
    town.block(16, 15, 24, 21, street + 3);
    town.block(16, 69, 24, 75, street + 3);
    EXPECT_FALSE(is_bridge(town));
}

TEST(Bridges, ARowOfHousesOnASlopeIsNot) {
    Town town(40, 90, {1, 1},
              [](std::int32_t, std::int32_t c) { return street + 0.05F * static_cast<float>(c); });
    town.block(16, 15, 24, 75, street + 8);
    EXPECT_FALSE(is_bridge(town));
}

TEST(Bridges, AnUnevenDeckIsNone) {
    Town town(40, 90, {1, 1}, valley);
    town.build([](std::int32_t r, std::int32_t c) {
        return r >= 18 && r < 22 && c >= 24 && c < 66 ? street + 1 + static_cast<float>(c / 3 % 2) : unknown;
    });
    EXPECT_FALSE(is_bridge(town));
}

/// A deck of 40 x 4 m between banks, which are not objects because the terrain is high there.
Town between(float bank) {
    Town town(40, 90);
    town.block(18, 25, 22, 65, street + 6);
    for (const std::int32_t left : {15, 66})
        town.build([=](std::int32_t r, std::int32_t c) {
            return r >= 14 && r < 26 && c >= left && c < left + 9 ? street + bank : unknown;
        });
    return town;
}

/// Crowns that detection takes for no objects: all that is high but the deck.
bool is_bridge_between(float bank) {
    const Town town = between(bank);
    Mask deck(town.surface.rows, town.surface.cols);
    for (std::int32_t r = 18; r < 22; ++r)
        for (std::int32_t c = 25; c < 65; ++c)
            deck.at(r, c) = 1;
    const Regions regions = connected_regions(deck, 1, 0, threads());
    std::vector<DetectedObject> objects(1, DetectedObject{.confidence = usual_confidence});
    doubt_bridges(town.scene(), regions, objects, threads());
    return counter_evidence_name(objects.front().doubt) == "bridge";
}

TEST(Bridges, ADeckBetweenHighBanksIsOne) {
    EXPECT_TRUE(is_bridge_between(6));
    EXPECT_TRUE(is_bridge_between(5));
    EXPECT_TRUE(is_bridge_between(15));
    EXPECT_FALSE(is_bridge_between(4));
    EXPECT_FALSE(is_bridge_between(0));
}

/// An object 8 m wide with cars on it.
/// @param dip depth of the valley in its middle @param step height of the cars
Town viaduct(std::int32_t length, float dip, float step = 1) {
    Town town(30, length, {1, 1}, [=](std::int32_t, std::int32_t c) {
        return street - (std::abs(c - length / 2) < length / 4 ? dip : 0);
    });
    town.build([=](std::int32_t r, std::int32_t c) {
        return r >= 11 && r < 19 ? street + 8 + step * static_cast<float>(c / 3 % 2) : unknown;
    });
    return town;
}

TEST(Bridges, ALongViaductOverAValleyIsOneWhateverStandsOnIt) {
    EXPECT_TRUE(is_bridge(viaduct(260, 6)));
    EXPECT_FALSE(is_bridge(viaduct(240, 6)));
    EXPECT_FALSE(is_bridge(viaduct(260, 1))) << "a long building";
    EXPECT_FALSE(is_bridge(viaduct(260, 6, 2))) << "a row of houses";
}

TEST(Bridges, DoubtIsNotReplacedByAHigherConfidence) {
    Town town(40, 90, {1, 1}, valley);
    town.block(18, 5, 22, 85, street + 1);
    const Regions regions = connected_regions(raised(town), 1, 0, threads());
    std::vector<DetectedObject> objects(regions.count(),
                                        DetectedObject{.confidence = 0.01, .doubt = CounterEvidence::steep});
    doubt_bridges(town.scene(), regions, objects, threads());
    EXPECT_EQ(objects.front().confidence, 0.01);
    EXPECT_EQ(objects.front().doubt, CounterEvidence::steep);
}

}  // namespace
}  // namespace d2b::detect

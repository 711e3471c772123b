#include <cstdint>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "pipeline/made_town.hpp"

namespace d2b {
namespace {

using test::buildings;
using test::contours;

/// What a feature is and what its fields say are one thing.
TEST(FeatureRecords, SayWhatTheFieldsSay) {
    test::TownRun town;
    town.options.write.rejected = true;
    town.options.outline.wall_tolerance = 0.2;  // no wall comes so near to a staircase
    town.run();
    ASSERT_EQ(town.count(buildings), 3U);
    for (std::size_t i = 0; i < town.count(buildings); ++i) {
        const auto& building = std::get<BuildingRecord>(town.sink.features[buildings][i].record);
        EXPECT_EQ(building.id, town.sink.whole(buildings, i, "id"));
        EXPECT_EQ(building.ground, town.sink.number(buildings, i, "ground"));
        EXPECT_EQ(building.roof, town.sink.number(buildings, i, "roof"));
        EXPECT_EQ(building.area_m2, town.sink.number(buildings, i, "area_m2"));
    }
    for (std::size_t i = 0; i < town.count(contours); ++i) {
        const auto& contour = std::get<ContourRecord>(town.sink.features[contours][i].record);
        EXPECT_EQ(contour.id, town.sink.whole(contours, i, "id"));
        EXPECT_EQ(contour.level, town.sink.whole(contours, i, "level"));
        EXPECT_EQ(contour.base, town.sink.number(contours, i, "base"));
        EXPECT_EQ(contour.top, town.sink.number(contours, i, "top"));
        EXPECT_EQ(contour.area_m2, town.sink.number(contours, i, "area_m2"));
    }
    const std::size_t rejected = town.sink.features.size() - 1;
    ASSERT_GT(town.count(rejected), 0U);
    for (std::size_t i = 0; i < town.count(rejected); ++i)
        EXPECT_EQ(
            FieldValue{std::string(std::get<RejectedRecord>(town.sink.features[rejected][i].record).reason)},
            town.sink.value(rejected, i, "reason"));
}

/// A stack from its records alone: no gap, and every contour on one of the level below.
TEST(FeatureRecords, AreEnoughToStackATower) {
    test::TownRun town;
    town.run();
    std::int64_t with_parent = 0;
    for (const Feature& feature : town.sink.features[contours]) {
        const auto& contour = std::get<ContourRecord>(feature.record);
        EXPECT_LE(contour.base, contour.top);
        if (contour.parent_id == 0)
            continue;
        ++with_parent;
        for (const Feature& other : town.sink.features[contours]) {
            const auto& below = std::get<ContourRecord>(other.record);
            if (below.id != contour.parent_id)
                continue;
            EXPECT_EQ(below.building_id, contour.building_id);
            EXPECT_EQ(below.level, contour.level - 1);
            EXPECT_EQ(below.top, contour.base);
        }
    }
    EXPECT_GT(with_parent, 0);
}

}  // namespace
}  // namespace d2b

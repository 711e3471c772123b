#include <cmath>

#include <gtest/gtest.h>

#include "features/attribute_table.hpp"
#include "features/record_builder.hpp"
#include "support/trace_grid.hpp"

namespace d2b {
namespace {

using test::nodata;

/// 8 x 10 cells of ground at 50 with two labels: 4 x 6 cells at 60, of which 2 x 3 are at 70 and two are not
/// known; and a cell at 55.
test::TraceGrid two_buildings() {
    test::TraceGrid grid{8, 10, std::vector<double>(80, 50.0), std::vector<Label>(80, 0)};
    for (int row = 2; row <= 5; ++row)
        for (int col = 2; col <= 7; ++col) {
            const auto i = static_cast<std::size_t>(row * 10 + col);
            grid.z[i] = row >= 3 && row <= 4 && col >= 3 && col <= 5 ? 70 : 60;
            grid.labels[i] = 1;
        }
    grid.z[22] = grid.z[57] = nodata;
    grid.z[9] = 55;
    grid.labels[9] = 2;
    return grid;
}

const std::vector<Footprint> footprints{{}, {48, 0.75, "steep"}, {50, 0.95, "rough"}};

/// Records of the grid, with thresholds of 65 in the large building.
test::Records footprint_records(double metres = 1, const std::vector<Footprint>& of = footprints) {
    const test::TraceGrid grid = two_buildings();
    const LevelPlan plan{50, {{}, {48, 65}, {50}}, true};
    Context context;
    test::TraceSettings settings{TraceMode::cells, 5};
    settings.keep_roots = false;
    const test::ContourSet set = test::trace_plan(grid, plan, settings, context);
    const FixedPoint fixed(70);
    return test::make_records(set, {plan, fixed, of, metres, {{0, 0}, {8, 10}}, 1});
}

/// Parts have the lowest id among those that a building was divided into; what was not divided has none.
TEST(FootprintRecords, KnowTheBuildingThatTheyArePartsOf) {
    std::vector<Footprint> of = footprints;
    for (const BuildingRecord& record : footprint_records(1, of).buildings)
        EXPECT_EQ(record.whole, 0);
    of[1].whole = 1;
    of[2].whole = 2;
    for (const BuildingRecord& record : footprint_records(1, of).buildings)
        EXPECT_EQ(record.whole, 0);
    of[2].whole = 1;
    const test::Records divided = footprint_records(1, of);
    const std::int64_t lowest = std::min(divided.buildings[0].id, divided.buildings[1].id);
    for (const BuildingRecord& record : divided.buildings)
        EXPECT_EQ(record.whole, lowest);
}

TEST(FootprintRecords, StandOnTheirGround) {
    const test::Records records = footprint_records(0.3048);
    ASSERT_EQ(records.buildings.size(), 2U);
    const BuildingRecord& small = records.buildings[0];  // first in scan order
    EXPECT_EQ(small.ground, 50);
    EXPECT_EQ(small.roof, 55);
    EXPECT_TRUE(small.at_edge);
    const BuildingRecord& large = records.buildings[1];
    EXPECT_EQ(large.ground, 48);
    EXPECT_EQ(large.roof, 70);
    EXPECT_DOUBLE_EQ(large.height_m, 22 * 0.3048);
    EXPECT_DOUBLE_EQ(large.heights_m[0], 12 * 0.3048);
    EXPECT_EQ(large.cells, 24);
    EXPECT_EQ(large.points, 22);
    EXPECT_DOUBLE_EQ(large.mean_m, ((16 * 60 + 6 * 70) / 22.0 - 48) * 0.3048);
    EXPECT_EQ(large.confidence, 0.75);
    EXPECT_EQ(large.parts, 2);
    EXPECT_EQ(large.levels, 2);
    EXPECT_FALSE(large.at_edge);
}

TEST(FootprintRecords, ContoursBeginAtTheGround) {
    const test::Records records = footprint_records();
    ASSERT_EQ(records.contours.size(), 3U);
    const ContourRecord& footprint = records.contours[1];
    EXPECT_EQ(footprint.level, 1);
    EXPECT_EQ(footprint.parent_id, 0);
    EXPECT_EQ(footprint.building_id, 2);
    EXPECT_EQ(footprint.threshold, 48);
    EXPECT_EQ(footprint.base, 48);
    EXPECT_EQ(footprint.top, 60);
    const ContourRecord& tower = records.contours[2];
    EXPECT_EQ(tower.parent_id, 2);
    EXPECT_EQ(tower.building_id, 2);
    EXPECT_EQ(tower.threshold, 65);
    EXPECT_EQ(tower.base, 60);
    EXPECT_EQ(tower.top, 70);
}

FieldValue value_of(const BuildingRecord& record, std::string_view name) {
    const auto attributes = building_attributes(true);
    for (const auto& attribute : attributes)
        if (attribute.name == name)
            return attribute.value(record);
    ADD_FAILURE() << "no field " << name;
    return {};
}

TEST(FootprintRecords, Fields) {
    BuildingRecord large = footprint_records().buildings[1];
    large.area_m2 = 6;
    EXPECT_EQ(value_of(large, "volume_m3"), FieldValue{88.36});  // 6 * ((16 * 60 + 6 * 70) / 22 - 48)
    EXPECT_DOUBLE_EQ(std::get<double>(value_of(large, "nodata")), 2 / 24.0);
    EXPECT_EQ(value_of(large, "n_cells"), FieldValue{std::int64_t{24}});
    EXPECT_EQ(value_of(large, "n_points"), FieldValue{std::int64_t{22}});
    EXPECT_EQ(value_of(large, "confidence"), FieldValue{0.75});
    EXPECT_EQ(value_of(large, "doubt"), FieldValue{std::string("steep")});
    large.deviation_m = 0.5;
    large.area_change = -0.01;
    large.status = OutlineStatus::regularized;
    EXPECT_EQ(value_of(large, "moved_m"), FieldValue{0.5});
    EXPECT_EQ(value_of(large, "area_chg"), FieldValue{-0.01});
    EXPECT_EQ(value_of(large, "status"), FieldValue{std::string("regularized")});
}

/// Elevations stay as they were computed.
TEST(FootprintRecords, AreWrittenAsFineAsTheDataCanCarry) {
    BuildingRecord record = footprint_records(1200.0 / 3937).buildings[1];
    EXPECT_EQ(value_of(record, "height"), FieldValue{6.71});  // 22 US survey feet are 6.70561 m
    EXPECT_EQ(value_of(record, "p50"), FieldValue{3.66});     // 3.65761
    record.ground = 47.123456;
    record.area_m2 = 24.23456;
    record.perimeter_m = 20.019;
    record.deviation_m = 0.1251;
    record.confidence = 0.8999;
    EXPECT_EQ(value_of(record, "ground"), FieldValue{47.123456});
    EXPECT_EQ(value_of(record, "area_m2"), FieldValue{24.23});
    EXPECT_EQ(value_of(record, "perim_m"), FieldValue{20.02});
    EXPECT_EQ(value_of(record, "moved_m"), FieldValue{0.13});
    EXPECT_EQ(value_of(record, "confidence"), FieldValue{0.89});  // and so it is doubted
    EXPECT_EQ(value_of(record, "doubt"), FieldValue{std::string("steep")});
}

TEST(FootprintRecords, PartsKnowHowSureTheirBuildingIs) {
    const test::Records records = footprint_records();
    EXPECT_EQ(records.contours[0].confidence, 0.95);
    EXPECT_EQ(records.contours[1].confidence, 0.75);
    EXPECT_EQ(records.contours[2].confidence, 0.75);
}

TEST(FootprintRecords, WhatIsSureIsNotDoubted) {
    EXPECT_EQ(value_of(footprint_records().buildings[0], "doubt"), FieldValue{});
}

TEST(FootprintRecords, WithoutDetectionNothingIsKnownOfIt) {
    BuildingRecord record = footprint_records().buildings[1];
    record.confidence = std::nan("");
    record.doubt = {};
    EXPECT_EQ(value_of(record, "confidence"), FieldValue{});
    EXPECT_EQ(value_of(record, "doubt"), FieldValue{});
    EXPECT_EQ(value_of(record, "nodata"), FieldValue{});
}

TEST(FootprintRecords, ABuildingWithoutAValidPoint) {
    test::TraceGrid grid = two_buildings();
    grid.z[9] = nodata;
    const LevelPlan plan{50, {{}, {48}, {50}}, true};
    Context context;
    test::TraceSettings settings{TraceMode::cells};
    settings.keep_roots = false;
    const test::ContourSet set = test::trace_plan(grid, plan, settings, context);
    const FixedPoint fixed(70);
    const test::Records records = test::make_records(set, {plan, fixed, footprints, 1, {{0, 0}, {8, 10}}, 1});
    const BuildingRecord& empty = records.buildings[0];
    EXPECT_EQ(empty.points, 0);
    EXPECT_EQ(empty.cells, 1);
    EXPECT_EQ(value_of(empty, "ground"), FieldValue{50.0});
    EXPECT_EQ(value_of(empty, "nodata"), FieldValue{1.0});
    for (const char* name : {"roof", "height", "p50", "p95", "num_floors", "volume_m3"})
        EXPECT_EQ(value_of(empty, name), FieldValue{}) << name;
    EXPECT_EQ(records.contours[0].top, 50);  // nothing stands there
}

PointStats holding(const std::vector<double>& elevations, const FixedPoint& fixed) {
    PointStats own;
    for (const double z : elevations)
        own.add(z, fixed);
    return own;
}

TEST(StackRmse, IsTheRootOfTheMeanSquareDistanceToTheTiers) {
    const FixedPoint fixed(100);
    // Tiers of 11 and 21: squares of 1, 1, 1, 1 and 4 over five points.
    StackRmse rmse;
    rmse.add(holding({10, 12}, fixed), fixed);
    rmse.add(holding({20, 20, 23}, fixed), fixed);
    EXPECT_DOUBLE_EQ(rmse.value(), std::sqrt(8 / 5.0));
    rmse.add(holding({0, 90}, fixed), fixed);
    EXPECT_DOUBLE_EQ(rmse.value(), std::sqrt((8 + 2 * 45 * 45) / 7.0));
}

TEST(StackRmse, DoesNotDependOnTheOrder) {
    const FixedPoint fixed(1 << 20);
    // Scatters of 2^37 and, many times, of 2^-17: doubles drop each of the small ones beside the large one.
    const PointStats large = holding({0, std::ldexp(1, 19)}, fixed);
    const PointStats small = holding({0, std::ldexp(1, -8)}, fixed);
    constexpr int times = 1 << 10;
    StackRmse first;
    StackRmse last;
    first.add(large, fixed);
    for (int i = 0; i < times; ++i) {
        first.add(small, fixed);
        last.add(small, fixed);
    }
    last.add(large, fixed);
    EXPECT_EQ(first.value(), last.value());
    EXPECT_EQ(first.value(), std::sqrt((std::ldexp(1, 37) + std::ldexp(1, -7)) / (2 + 2 * times)));
}

TEST(StackRmse, OfNothingIsZero) {
    StackRmse rmse;
    EXPECT_EQ(rmse.value(), 0);
    rmse.add({}, FixedPoint(2));
    EXPECT_EQ(rmse.value(), 0);
}

}  // namespace
}  // namespace d2b

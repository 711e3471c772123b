#include "features/record_builder.hpp"

#include <cmath>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "features/attribute_table.hpp"
#include "support/trace_grid.hpp"

namespace d2b::features {
namespace {

using test::TraceGrid;

/// Ground of 1, a podium of 10 with a tower of 20 on it, and a point of 30 on the tower.
TraceGrid podium() {
    TraceGrid grid{8, 10, std::vector<double>(80, 1.0), {}};
    for (int row = 2; row <= 5; ++row)
        for (int col = 2; col <= 7; ++col)
            grid.z[static_cast<std::size_t>(row * 10 + col)] =
                row >= 3 && row <= 4 && col >= 3 && col <= 5 ? 20 : 10;
    grid.z[33] = 30;
    return grid;
}

const std::vector<Footprint> no_footprints;

test::Records records_of(const TraceGrid& grid, const std::vector<double>& thresholds, double metres = 1) {
    Context context;
    const test::ContourSet set = test::trace_grid(grid, thresholds, {TraceMode::cells, 5}, context);
    ElevationStatistics statistics;
    statistics.add(grid.z);
    const contours::LevelPlan plan{statistics.minimum, {{}, thresholds}};
    const FixedPoint fixed = statistics.fixed_point();
    return test::make_records(set, {plan, fixed, no_footprints, metres, {{0, 0}, {grid.rows, grid.cols}}});
}

TEST(Records, ContoursOfAPodiumWithATower) {
    const test::Records records = records_of(podium(), {4, 8, 15});
    ASSERT_EQ(records.contours.size(), 4U);
    const ContourRecord& root = records.contours[0];
    EXPECT_EQ(root.threshold, 1);
    EXPECT_EQ(root.base, 1);
    EXPECT_EQ(root.top, 1);
    EXPECT_EQ(root.points, 80);
    EXPECT_EQ(root.tier_z, 1);
    const ContourRecord& level1 = records.contours[1];
    EXPECT_EQ(level1.threshold, 4);
    EXPECT_EQ(level1.base, 1);               // the ground
    EXPECT_TRUE(std::isnan(level1.tier_z));  // its child holds all its points
    EXPECT_EQ(level1.top, 8);                // so it ends at the child's threshold
    EXPECT_EQ(level1.points, 24);
    const ContourRecord& level2 = records.contours[2];
    EXPECT_EQ(level2.base, 8);
    EXPECT_EQ(level2.tier_z, 10);
    EXPECT_EQ(level2.top, 10);
    const ContourRecord& tower = records.contours[3];
    EXPECT_EQ(tower.base, 10);
    EXPECT_DOUBLE_EQ(tower.tier_z, (5 * 20 + 30) / 6.0);
    EXPECT_DOUBLE_EQ(tower.top, (5 * 20 + 30) / 6.0);
    EXPECT_TRUE(std::isnan(root.height_m));
    EXPECT_EQ(level1.min_height_m, 0);
    EXPECT_EQ(level1.height_m, 7);
    EXPECT_EQ(level2.min_height_m, 7);
    EXPECT_EQ(tower.min_height_m, 9);
    EXPECT_DOUBLE_EQ(tower.height_m, (5 * 20 + 30) / 6.0 - 1);
    EXPECT_EQ(tower.lowest, 20);
    EXPECT_EQ(tower.highest, 30);
    EXPECT_DOUBLE_EQ(level1.mean, (18 * 10 + 5 * 20 + 30) / 24.0);
}

TEST(Records, BuildingOfAPodiumWithATowerInFeet) {
    const test::Records records = records_of(podium(), {4, 8, 15}, 0.3048);
    ASSERT_EQ(records.buildings.size(), 1U);
    EXPECT_DOUBLE_EQ(records.contours[1].height_m, 7 * 0.3048);
    const BuildingRecord& building = records.buildings[0];
    EXPECT_EQ(building.ground, 1);
    EXPECT_EQ(building.roof, 30);
    EXPECT_DOUBLE_EQ(building.height_m, 29 * 0.3048);
    EXPECT_DOUBLE_EQ(building.heights_m[0], 9 * 0.3048);   // the 12th of 24: 10
    EXPECT_DOUBLE_EQ(building.heights_m[3], 19 * 0.3048);  // the 23rd: 20
    EXPECT_EQ(building.parts, 3);
    EXPECT_EQ(building.levels, 3);
    EXPECT_EQ(building.points, 24);
    EXPECT_FALSE(building.at_edge);
}

TEST(Records, StacksStandWithoutGaps) {
    const test::Records records = records_of(podium(), {4, 8, 9.5, 12, 15, 25});
    for (std::size_t i = 0; i < records.contours.size(); ++i) {
        EXPECT_EQ(records.contours[i].level, static_cast<std::int32_t>(i));
        EXPECT_LE(records.contours[i].base, records.contours[i].top);
        if (i > 1) {
            EXPECT_EQ(records.contours[i].base, records.contours[i - 1].top);
        }
    }
}

TEST(Records, AtTheEdgeAndWithoutGround) {
    TraceGrid grid{4, 4, std::vector<double>(16, 9.0), {}};
    grid.z[15] = test::nodata;
    grid.z[0] = 1;  // the minimum; it lies diagonally across from the block's far corner
    for (const std::size_t i : {1U, 4U, 5U})
        grid.z[i] = test::nodata;
    const test::Records records = records_of(grid, {5});
    ASSERT_EQ(records.buildings.size(), 1U);
    EXPECT_TRUE(records.buildings[0].at_edge);
    EXPECT_TRUE(std::isnan(records.buildings[0].ground));
    EXPECT_TRUE(std::isnan(records.buildings[0].height_m));
    EXPECT_EQ(records.contours.back().base, 5);
}

template <typename Record>
void expect_good_names(std::span<const Attribute<Record>> attributes) {
    std::set<std::string_view> names;
    for (const Attribute<Record>& attribute : attributes) {
        EXPECT_LE(attribute.name.size(), 10U) << attribute.name;
        EXPECT_EQ(attribute.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"),
                  std::string_view::npos);
        EXPECT_TRUE(names.insert(attribute.name).second) << attribute.name;
        EXPECT_FALSE(attribute.alias.empty());
        EXPECT_FALSE(attribute.description.empty());
    }
}

TEST(AttributeTable, NamesSurviveAShapefile) {
    expect_good_names(building_attributes(true, true));
    expect_good_names(contour_attributes());
}

TEST(AttributeTable, ValuesHaveTheTypesOfTheirFields) {
    const test::Records records = records_of(podium(), {4, 8, 15});
    const auto check = [](FieldType type, const FieldValue& value) {
        if (std::holds_alternative<std::monostate>(value))
            return true;
        return type == FieldType::integer ? std::holds_alternative<std::int64_t>(value)
               : type == FieldType::real  ? std::holds_alternative<double>(value)
                                          : std::holds_alternative<std::string>(value);
    };
    const auto values = field_values(building_attributes(true, true), records.buildings[0]);
    const auto fields = field_specs(building_attributes(true, true), "foot");
    ASSERT_EQ(values.size(), fields.size());
    for (std::size_t i = 0; i < fields.size(); ++i)
        EXPECT_TRUE(check(fields[i].type, values[i])) << fields[i].name;
    EXPECT_EQ(fields[1].alias, "Ground (foot)");
    EXPECT_EQ(fields[3].unit, "m");
    const auto contour_values = field_values(contour_attributes(), records.contours[0]);
    EXPECT_TRUE(std::holds_alternative<std::monostate>(contour_values[1]));  // no parent
    EXPECT_TRUE(std::holds_alternative<std::monostate>(contour_values[2]));  // no building
}

TEST(AttributeTable, FloorsAreStoreysOfThreeMetres) {
    BuildingRecord record;
    const auto floors = [&](double p95) {
        record.heights_m[3] = p95;
        const auto values = field_values(building_attributes(true, true), record);
        return values[9];
    };
    EXPECT_EQ(floors(2.5), FieldValue{std::int64_t{1}});
    EXPECT_EQ(floors(0.5), FieldValue{std::int64_t{1}});
    EXPECT_EQ(floors(10.4), FieldValue{std::int64_t{3}});
    EXPECT_EQ(floors(10.6), FieldValue{std::int64_t{4}});
    EXPECT_EQ(floors(std::nan("")), FieldValue{});
}

/// A house of 12 x 10 m whose points lie at 9 m.
BuildingRecord house() {
    BuildingRecord record;
    record.ground = 50;
    record.height_m = 9.5;
    record.roof = record.ground + record.height_m;
    record.heights_m = {9, 9, 9, 9};
    record.area_m2 = 120;
    record.perimeter_m = 44;
    return record;
}

FieldValue floors_of(const BuildingRecord& record) {
    return field_values(building_attributes(true, true), record)[9];
}

TEST(AttributeTable, FloorsFollowTheHeightOfAStorey) {
    BuildingRecord record = house();
    for (const auto& [storey, floors] : {std::pair{3.0, 3}, {4.5, 2}, {2.0, 5}, {20.0, 1}}) {
        record.storey_m = storey;
        EXPECT_EQ(floors_of(record), FieldValue{std::int64_t{floors}}) << storey;
    }
}

/// 50 x 50 m under one roof of 12 m, which is less than a third of the width.
TEST(AttributeTable, HallsHaveNoFloors) {
    BuildingRecord hall = house();
    hall.heights_m = {11, 11.5, 12, 12};
    hall.area_m2 = 2500;
    hall.perimeter_m = 200;
    EXPECT_EQ(floors_of(hall), FieldValue{});
    BuildingRecord other = hall;
    other.heights_m[0] = 8.9;  // parts differ by more than a storey
    EXPECT_EQ(floors_of(other), FieldValue{std::int64_t{4}});
    other = hall;
    other.heights_m = {25, 26, 26, 26};  // an office
    EXPECT_EQ(floors_of(other), FieldValue{std::int64_t{9}});
    other = hall;
    other.perimeter_m = 340;  // courtyards give light
    EXPECT_EQ(floors_of(other), FieldValue{std::int64_t{4}});
    other = hall;
    other.heights_m = {4, 4, 4, 4};  // one floor, however wide
    EXPECT_EQ(floors_of(other), FieldValue{std::int64_t{1}});
}

/// A nave of 18 m with a spire of 52 m; with planes of the roof, a ridge of 30 m above eaves of 17 m.
TEST(AttributeTable, ChurchesHaveNoFloors) {
    BuildingRecord church = house();
    church.area_m2 = 660;
    church.perimeter_m = 140;
    church.heights_m = {18, 20, 34, 39};
    church.height_m = 52;
    church.roof = church.ground + 52;
    EXPECT_EQ(floors_of(church), FieldValue{});
    church.height_m = 35;
    church.heights_m = {18, 20, 25, 30};
    church.roof = church.ground + 35 / 0.3;  // in feet, nearly
    EXPECT_EQ(floors_of(church), FieldValue{std::int64_t{10}});
    church.roof_shape.type = "gabled";
    church.roof_shape.eave_z = church.ground + 17 / 0.3;
    EXPECT_EQ(floors_of(church), FieldValue{});
    church.roof_shape.eave_z = church.ground + 22 / 0.3;  // 8 m of roof are attics
    EXPECT_EQ(floors_of(church), FieldValue{std::int64_t{10}});
    church.roof_shape.eave_z = church.ground + 17 / 0.3;
    church.roof_shape.type = "flat";
    EXPECT_EQ(floors_of(church), FieldValue{std::int64_t{10}});
    // A tower on a podium that is lower than four storeys.
    church = house();
    church.height_m = 33;
    EXPECT_EQ(floors_of(church), FieldValue{std::int64_t{3}});
}

/// 5 x 5 m and 24 m high; a round tank of 10 m and 24 m.
TEST(AttributeTable, ChimneysAndTanksHaveNoFloors) {
    BuildingRecord tower = house();
    tower.height_m = 24;
    tower.roof = tower.ground + 24;
    tower.heights_m = {24, 24, 24, 24};
    tower.area_m2 = 25;
    tower.perimeter_m = 20;
    EXPECT_EQ(floors_of(tower), FieldValue{});
    tower.area_m2 = 78.5;
    tower.perimeter_m = 31.4;
    EXPECT_EQ(floors_of(tower), FieldValue{std::int64_t{8}});
    tower.roof_shape.type = "domed";
    EXPECT_EQ(floors_of(tower), FieldValue{});
    tower.area_m2 = 100;
    tower.perimeter_m = 40;  // a square
    EXPECT_EQ(floors_of(tower), FieldValue{std::int64_t{8}});
}

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
    const contours::LevelPlan plan{50, {{}, {48, 65}, {50}}, true};
    Context context;
    test::TraceSettings settings{TraceMode::cells, 5};
    settings.keep_roots = false;
    const test::ContourSet set = test::trace_plan(grid, plan, settings, context);
    const FixedPoint fixed(70);
    return test::make_records(set, {plan, fixed, of, metres, {{0, 0}, {8, 10}}});
}

/// A footprint's whole is that of its record; whether it was divided is seen from all footprints.
TEST(FootprintRecords, KnowTheWholeThatTheyArePartsOf) {
    std::vector<Footprint> of = footprints;
    for (const BuildingRecord& record : footprint_records(1, of).buildings)
        EXPECT_EQ(record.whole, 0);
    of[1].whole = 7;
    of[2].whole = -2;
    const test::Records records = footprint_records(1, of);
    ASSERT_EQ(records.buildings.size(), 2U);
    std::set<std::int64_t> wholes;
    for (const BuildingRecord& record : records.buildings)
        wholes.insert(record.whole);
    EXPECT_EQ(wholes, (std::set<std::int64_t>{-2, 7}));
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
    EXPECT_EQ(footprint.threshold, 48);
    EXPECT_EQ(footprint.base, 48);
    EXPECT_EQ(footprint.top, 60);
    const ContourRecord& tower = records.contours[2];
    EXPECT_EQ(tower.threshold, 65);
    EXPECT_EQ(tower.base, 60);
    EXPECT_EQ(tower.top, 70);
}

FieldValue value_of(const BuildingRecord& record, std::string_view name) {
    const auto attributes = building_attributes(true, true);
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
    record.area_m2 = 0.00005;  // of degrees without a CRS
    EXPECT_EQ(value_of(record, "area_m2"), FieldValue{0.00005});
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
    const contours::LevelPlan plan{50, {{}, {48}, {50}}, true};
    Context context;
    test::TraceSettings settings{TraceMode::cells};
    settings.keep_roots = false;
    const test::ContourSet set = test::trace_plan(grid, plan, settings, context);
    const FixedPoint fixed(70);
    const test::Records records = test::make_records(set, {plan, fixed, footprints, 1, {{0, 0}, {8, 10}}});
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

/// The fields of buildings that a program calls otherwise.
std::map<std::string, std::string> renamed(FieldNames names) {
    std::map<std::string, std::string> result;
    for (const Attribute<BuildingRecord>& attribute : building_attributes(true, true))
        if (const std::string_view other = field_name(names, attribute.name); other != attribute.name)
            result[std::string(attribute.name)] = other;
    return result;
}

using Names = std::map<std::string, std::string>;

TEST(FieldNames, OtherProgramsFindTheirs) {
    EXPECT_EQ(renamed(FieldNames::urock), (Names{{"id", "ID_BUILD"}, {"p90", "ROOF_HEIGHT"}}));
    EXPECT_EQ(renamed(FieldNames::city4cfd),
              (Names{{"id", "unique_id"}, {"num_floors", "floors"}, {"min_height", "base_height"}}));
    EXPECT_EQ(renamed(FieldNames::osm), (Names{{"num_floors", "building:levels"}, {"ground", "ele"}}));
}

TEST(FieldNames, StayDistinct) {
    for (const FieldNames names :
         {FieldNames::own, FieldNames::urock, FieldNames::city4cfd, FieldNames::osm}) {
        std::set<std::string> seen;
        for (const FieldSpec& field : field_specs(building_attributes(true, true), "metre", names))
            EXPECT_TRUE(seen.insert(field.name).second) << field.name;
        EXPECT_EQ(seen.size(), building_attributes(true, true).size());
    }
}

TEST(FieldNames, ChangeNothingElseOfAField) {
    const auto own = field_specs(building_attributes(true, true), "foot");
    const auto other = field_specs(building_attributes(true, true), "foot", FieldNames::urock);
    ASSERT_EQ(own.size(), other.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
        EXPECT_EQ(own[i].alias, other[i].alias);
        EXPECT_EQ(own[i].type, other[i].type);
        EXPECT_EQ(own[i].unit, other[i].unit);
        EXPECT_EQ(own[i].description, other[i].description);
    }
}

}  // namespace
}  // namespace d2b::features

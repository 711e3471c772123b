#include <cmath>

#include <gtest/gtest.h>

#include "attributes/attribute_table.hpp"
#include "attributes/records.hpp"
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
Records footprint_records(double metres = 1) {
    const test::TraceGrid grid = two_buildings();
    const LevelPlan plan{50, {{}, {48, 65}, {50}}, true};
    Context context;
    ContourSet set = test::trace_plan(grid, plan, {TraceMode::cells, 5}, context);
    drop_roots(set);
    const FixedPoint fixed(70);
    return make_records({set.contours, set.building, set.buildings, set.percentiles, footprints},
                        {plan, fixed, metres, {{0, 0}, {8, 10}}, 1});
}

TEST(FootprintRecords, StandOnTheirGround) {
    const Records records = footprint_records(0.3048);
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
    const Records records = footprint_records();
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
    const auto attributes = building_attributes();
    for (const auto& attribute : attributes)
        if (attribute.name == name)
            return attribute.value(record);
    ADD_FAILURE() << "no field " << name;
    return {};
}

TEST(FootprintRecords, Fields) {
    BuildingRecord large = footprint_records().buildings[1];
    large.area_m2 = 6;
    EXPECT_DOUBLE_EQ(std::get<double>(value_of(large, "volume_m3")), 6 * ((16 * 60 + 6 * 70) / 22.0 - 48));
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
    ContourSet set = test::trace_plan(grid, plan, {TraceMode::cells}, context);
    drop_roots(set);
    const Records records =
        make_records({set.contours, set.building, set.buildings, set.percentiles, footprints},
                     {plan, FixedPoint(70), 1, {{0, 0}, {8, 10}}, 1});
    const BuildingRecord& empty = records.buildings[0];
    EXPECT_EQ(empty.points, 0);
    EXPECT_EQ(empty.cells, 1);
    EXPECT_EQ(value_of(empty, "ground"), FieldValue{50.0});
    EXPECT_EQ(value_of(empty, "nodata"), FieldValue{1.0});
    for (const char* name : {"roof", "height", "p50", "p95", "num_floors", "volume_m3"})
        EXPECT_EQ(value_of(empty, name), FieldValue{}) << name;
    EXPECT_EQ(records.contours[0].top, 50);  // nothing stands there
}

/// A contour with these points of its own.
Contour holding(std::int32_t level, const std::vector<double>& elevations, const FixedPoint& fixed) {
    Contour contour;
    contour.key.level = level;
    contour.label = 1;
    for (const double z : elevations)
        contour.own.add(z, fixed);
    return contour;
}

TEST(StackRmse, IsTheRootOfTheMeanSquareDistanceToTheTiers) {
    const FixedPoint fixed(100);
    // Tiers of 11 and 21: squares of 1, 1, 1, 1 and 4 over five points. The ground does not count.
    const std::vector<Contour> contours{holding(0, {0, 100}, fixed), holding(1, {10, 12}, fixed),
                                        holding(2, {20, 20, 23}, fixed)};
    EXPECT_DOUBLE_EQ(stack_rmse(contours, fixed, 1), std::sqrt(8 / 5.0));
    std::vector<Contour> more = contours;
    more.push_back(holding(1, {0, 90}, fixed));
    more.back().label = 2;
    EXPECT_DOUBLE_EQ(stack_rmse(more, fixed, 1), std::sqrt(8 / 5.0));
    EXPECT_DOUBLE_EQ(stack_rmse(more, fixed, 2), std::sqrt((8 + 2 * 45 * 45) / 7.0));
}

TEST(StackRmse, OfNothingIsZero) {
    EXPECT_EQ(stack_rmse({}, FixedPoint(1), 1), 0);
    const FixedPoint fixed(2);
    EXPECT_EQ(stack_rmse({holding(0, {1, 2}, fixed), holding(1, {}, fixed)}, fixed, 1), 0);
}

}  // namespace
}  // namespace d2b

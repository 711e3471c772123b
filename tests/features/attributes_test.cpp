#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "features/attribute_table.hpp"
#include "features/record_builder.hpp"
#include "support/trace_grid.hpp"

namespace d2b {
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

test::Records records_of(const TraceGrid& grid, const std::vector<double>& thresholds, double metres = 1,
                         std::int64_t first_id = 1) {
    Context context;
    const test::ContourSet set = test::trace_grid(grid, thresholds, {TraceMode::cells, 5}, context);
    ElevationStatistics statistics;
    statistics.add({{0, grid.rows, grid.cols}, grid.z});
    const LevelPlan plan{statistics.minimum, {{}, thresholds}};
    const FixedPoint fixed = statistics.fixed_point();
    return test::make_records(
        set, {plan, fixed, no_footprints, metres, {{0, 0}, {grid.rows, grid.cols}}, first_id});
}

TEST(Records, ContoursOfAPodiumWithATower) {
    const test::Records records = records_of(podium(), {4, 8, 15});
    ASSERT_EQ(records.contours.size(), 4U);
    const ContourRecord& root = records.contours[0];
    EXPECT_EQ(root.id, 1);
    EXPECT_EQ(root.parent_id, 0);
    EXPECT_EQ(root.building_id, 0);
    EXPECT_EQ(root.threshold, 1);
    EXPECT_EQ(root.base, 1);
    EXPECT_EQ(root.top, 1);
    EXPECT_EQ(root.points, 80);
    EXPECT_EQ(root.tier_z, 1);
    const ContourRecord& level1 = records.contours[1];
    EXPECT_EQ(level1.parent_id, 1);
    EXPECT_EQ(level1.building_id, 1);
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
    EXPECT_EQ(tower.parent_id, 3);
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
    for (const ContourRecord& record : records.contours) {
        EXPECT_LE(record.base, record.top);
        if (record.level > 1) {
            EXPECT_EQ(record.base, records.contours[static_cast<std::size_t>(record.parent_id - 1)].top);
        }
    }
}

TEST(Records, IdsGoOnFromWhatIsThere) {
    const test::Records records = records_of(podium(), {4}, 1, 100);
    EXPECT_EQ(records.contours[1].id, 101);
    EXPECT_EQ(records.contours[1].parent_id, 100);
    EXPECT_EQ(records.contours[1].building_id, 100);
    EXPECT_EQ(records.buildings[0].id, 100);
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
    expect_good_names(building_attributes(true));
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
    const auto values = field_values(building_attributes(true), records.buildings[0]);
    const auto fields = field_specs(building_attributes(true), "foot");
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
        const auto values = field_values(building_attributes(true), record);
        return values[9];
    };
    EXPECT_EQ(floors(2.5), FieldValue{std::int64_t{1}});
    EXPECT_EQ(floors(0.5), FieldValue{std::int64_t{1}});
    EXPECT_EQ(floors(10.4), FieldValue{std::int64_t{3}});
    EXPECT_EQ(floors(10.6), FieldValue{std::int64_t{4}});
    EXPECT_EQ(floors(std::nan("")), FieldValue{});
}

TEST(AttributeTable, MarkdownHasEveryField) {
    const std::string text = schema_markdown();
    for (const auto& attribute : building_attributes(true))
        EXPECT_NE(text.find("| `" + std::string(attribute.name) + "` |"), std::string::npos);
    for (const auto& attribute : contour_attributes())
        EXPECT_NE(text.find("| `" + std::string(attribute.name) + "` |"), std::string::npos);
}

TEST(Status, HasANameForEach) {
    EXPECT_EQ(status_name(OutlineStatus::traced), "traced");
    EXPECT_EQ(status_name(OutlineStatus::simplified), "simplified");
    EXPECT_EQ(status_name(OutlineStatus::regularized), "regularized");
    EXPECT_EQ(status_name(OutlineStatus::kept_traced), "kept_traced");
    EXPECT_EQ(status_name(OutlineStatus::repaired), "repaired");
}

}  // namespace
}  // namespace d2b

#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "features/attribute_table.hpp"

namespace d2b {
namespace {

/// The fields of buildings that a program calls otherwise.
std::map<std::string, std::string> renamed(FieldNames names) {
    std::map<std::string, std::string> result;
    for (const Attribute<BuildingRecord>& attribute : building_attributes(true))
        if (const std::string_view other = field_name(names, attribute.name); other != attribute.name)
            result[std::string(attribute.name)] = other;
    return result;
}

using Names = std::map<std::string, std::string>;

TEST(FieldNames, OwnOnesStay) {
    EXPECT_EQ(renamed(FieldNames::own), Names{});
}

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
        for (const FieldSpec& field : field_specs(building_attributes(true), "metre", names))
            EXPECT_TRUE(seen.insert(field.name).second) << field.name;
        EXPECT_EQ(seen.size(), building_attributes(true).size());
    }
}

TEST(FieldNames, ChangeNothingElseOfAField) {
    const auto own = field_specs(building_attributes(true), "foot");
    const auto other = field_specs(building_attributes(true), "foot", FieldNames::urock);
    ASSERT_EQ(own.size(), other.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
        EXPECT_EQ(own[i].alias, other[i].alias);
        EXPECT_EQ(own[i].type, other[i].type);
        EXPECT_EQ(own[i].unit, other[i].unit);
        EXPECT_EQ(own[i].description, other[i].description);
    }
}

}  // namespace
}  // namespace d2b

#include "dem2buildings_mesh/read_city.hpp"

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "mesh/made_city.hpp"
#include "support/error_of.hpp"

namespace d2b::test {
namespace {

using mesh::parse_city;
using nlohmann::json;

json one_box() {
    return made_city({made_box("building_1", 0, 0, 160, 80, 9000, 1000)});
}

json& solid(json& city) {
    return city["CityObjects"]["building_1"]["geometry"][0];
}

std::string said_of(const std::string& text) {
    return error_of<InputError>([&] { static_cast<void>(parse_city(text, "x")); });
}

TEST(ReadCity, readsABox) {
    const mesh::CityModel city = parse_city(one_box().dump(), "x");
    ASSERT_EQ(city.buildings.size(), 1U);
    EXPECT_EQ(city.buildings[0].name, "building_1");
    EXPECT_EQ(city.buildings[0].attributes, R"({"id":1})");
    EXPECT_EQ(city.buildings[0].base, 1000);
    ASSERT_EQ(city.buildings[0].roofs.size(), 1U);
    EXPECT_EQ(city.buildings[0].roofs[0].z, 9000);
    EXPECT_EQ(city.buildings[0].roofs[0].outline.exterior,
              (FineRing{{0, 0}, {0, 160}, {-80, 160}, {-80, 0}}));
    EXPECT_EQ(city.scale, (std::array{0.0625, 0.0625, 0.001}));
    EXPECT_EQ(city.lod, "1.2");
    EXPECT_EQ(mesh::place_text(city, {-80, 16}), "500001.000 5800005.000");
}

TEST(ReadCity, sortsBuildingsByTheirNumbers) {
    const json text =
        made_city({made_box("building_10", 0, 0, 8, 8, 9), made_box("building_2", 8, 0, 16, 8, 9)});
    const mesh::CityModel city = parse_city(text.dump(), "x");
    EXPECT_EQ(city.buildings[0].name, "building_2");
    EXPECT_EQ(city.buildings[1].name, "building_10");
}

/// Parts are the buildings, and the building that they are parts of has no geometry.
TEST(ReadCity, readsPartsOfADividedBuilding) {
    json text = made_city({made_box("building_2", 0, 0, 8, 8, 9), made_box("building_3", 8, 0, 16, 8, 7)});
    for (const char* name : {"building_2", "building_3"}) {
        text["CityObjects"][name]["type"] = "BuildingPart";
        text["CityObjects"][name]["parents"] = json::array({"whole_2"});
    }
    text["CityObjects"]["whole_2"] = {{"type", "Building"}, {"children", {"building_2", "building_3"}}};
    const mesh::CityModel city = parse_city(text.dump(), "x");
    ASSERT_EQ(city.buildings.size(), 2U);
    for (const mesh::CityBuilding& building : city.buildings)
        EXPECT_EQ(building.whole, "whole_2");
}

struct Damage {
    std::string name;
    std::function<void(json&)> damage;
    std::string said;
};

class DamagedCity : public ::testing::TestWithParam<Damage> {};

TEST_P(DamagedCity, isRefusedInASentence) {
    json city = one_box();
    GetParam().damage(city);
    EXPECT_EQ(said_of(city.dump()), "'x' " + GetParam().said);
}

const std::string give = "; give a file that -surface wrote.";
const std::string damaged = "; the file is damaged.";

INSTANTIATE_TEST_SUITE_P(
    ReadCity, DamagedCity,
    ::testing::
        Values(
            Damage{"version", [](json& c) { c["version"] = "1.1"; }, "is not CityJSON 2.0" + give},
            Damage{"noTransform", [](json& c) { c.erase("transform"); }, "has no 'transform' in it" + give},
            Damage{"noObjects", [](json& c) { c["CityObjects"] = 3; },
                   "has a 'CityObjects' in it that is not an object" + give},
            Damage{"noVertices", [](json& c) { c["vertices"] = 3; },
                   "has a 'vertices' in it that is not a list" + give},
            Damage{"twoScales",
                   [](json& c) {
                       c["transform"]["scale"] = {1, 1};
                   },
                   "has a 'scale' that is not three numbers" + damaged},
            Damage{"nullScale", [](json& c) { c["transform"]["scale"][1] = nullptr; },
                   "has a 'scale' that is not three numbers" + damaged},
            Damage{"zeroScale", [](json& c) { c["transform"]["scale"][1] = 0; },
                   "has a 'scale' that is unusable" + damaged},
            Damage{"halfVertex", [](json& c) { c["vertices"][0][1] = 0.5; },
                   "has a vertex that is not three whole numbers" + damaged},
            Damage{"shortVertex",
                   [](json& c) {
                       c["vertices"][0] = {1, 2};
                   },
                   "has a vertex that is not three whole numbers" + damaged},
            Damage{"farVertex", [](json& c) { c["vertices"][0][1] = std::int64_t{1} << 50; },
                   "has a vertex farther away than any city" + damaged},
            Damage{"systemIsNoText", [](json& c) { c["metadata"]["referenceSystem"] = 3; },
                   "has a 'referenceSystem' in its metadata that is not a text" + give},
            Damage{"bridge", [](json& c) { c["CityObjects"]["building_1"]["type"] = "Bridge"; },
                   "has 'building_1', which is neither a Building nor a BuildingPart" + give},
            Damage{"orphan", [](json& c) { c["CityObjects"]["building_1"]["type"] = "BuildingPart"; },
                   "has no 'parents' in building_1" + give},
            Damage{"strangeParent",
                   [](json& c) {
                       c["CityObjects"]["building_1"]["type"] = "BuildingPart";
                       c["CityObjects"]["building_1"]["parents"] = {"whole_1"};
                   },
                   "has 'building_1', a part of a missing building" + damaged},
            Damage{"nothingOfItsOwn", [](json& c) { c["CityObjects"]["building_1"].erase("geometry"); },
                   "has no 'geometry' in building_1" + give},
            Damage{"noGeometry", [](json& c) { c["CityObjects"]["building_1"]["geometry"] = json::array(); },
                   "does not have exactly one geometry in building_1" + give},
            Damage{"surface", [](json& c) { solid(c)["type"] = "MultiSurface"; },
                   "has a geometry in building_1 that is not a Solid" + give},
            Damage{"twoShells", [](json& c) { solid(c)["boundaries"].push_back(json::array()); },
                   "does not have exactly one shell in building_1" + give},
            Damage{"fewKinds", [](json& c) { solid(c)["semantics"]["values"][0].erase(0); },
                   "does not give for each face of building_1 its kind" + damaged},
            Damage{"noKind", [](json& c) { solid(c)["semantics"]["surfaces"][0]["type"] = "Window"; },
                   "has a face in building_1 that is neither roof nor wall nor ground" + give},
            Damage{"kindOutOfRange", [](json& c) { solid(c)["semantics"]["values"][0][0] = 3; },
                   "has an index in building_1 that is out of range" + damaged},
            Damage{"indexOutOfRange", [](json& c) { solid(c)["boundaries"][0][0][0][0] = 8; },
                   "has an index in building_1 that is out of range" + damaged},
            Damage{"negativeIndex", [](json& c) { solid(c)["boundaries"][0][0][0][0] = -1; },
                   "has an index in building_1 that is out of range" + damaged},
            Damage{"ringIsANumber", [](json& c) { solid(c)["boundaries"][0][0][0] = 5; },
                   "has a ring in building_1 that is not a list" + damaged},
            Damage{"noRing", [](json& c) { solid(c)["boundaries"][0][0] = json::array(); },
                   "has a face in building_1 without a ring" + damaged},
            Damage{"twoCorners",
                   [](json& c) {
                       solid(c)["boundaries"][0][0][0] = {1, 3};
                   },
                   "has a solid, building_1, that has a face of fewer than three corners" + damaged},
            Damage{"open",
                   [](json& c) {
                       solid(c)["boundaries"][0].erase(2);
                       solid(c)["semantics"]["values"][0].erase(2);
                   },
                   "has a solid, building_1, that is not closed" + damaged},
            Damage{"twice",
                   [](json& c) {
                       for (std::size_t face = 0; face < 6; ++face) {
                           solid(c)["boundaries"][0].push_back(json(solid(c)["boundaries"][0][face]));
                           solid(c)["semantics"]["values"][0].push_back(
                               json(solid(c)["semantics"]["values"][0][face]));
                       }
                   },
                   "has a solid, building_1, that is not closed" + damaged},
            Damage{"warped",
                   [](json& c) {
                       solid(c)["lod"] = "2.2";
                       c["vertices"][1][2] = 9500;
                   },
                   "has a solid, building_1, that has a roof that is not plane" + damaged},
            Damage{"pitched", [](json& c) { c["vertices"][1][2] = 9500; },
                   "has a solid, building_1, that has a roof that is not level" + damaged},
            Damage{"slope", [](json& c) { c["vertices"][0][2] = 900; },
                   "has a solid, building_1, that has a ground that is not level" + damaged},
            Damage{"leaning",
                   [](json& c) {
                       c["vertices"][1][0] = 7;
                       c["vertices"][7][0] = 7;
                   },
                   "has a solid, building_1, that has a wall that is not upright" + damaged},
            Damage{
                "insideOut",
                [](json& c) {
                    for (json& face : solid(c)["boundaries"][0])
                        std::reverse(face[0].begin(), face[0].end());
                },
                "has a solid, building_1, that has a roof that faces the wrong way" + damaged}),
    [](const auto& city) { return city.param.name; });

TEST(ReadCity, refusesWhatIsNoJson) {
    const std::string no_json = "'x' is not complete JSON" + give;
    EXPECT_EQ(said_of(""), no_json);
    EXPECT_EQ(said_of("{\"type\":"), no_json);
    EXPECT_EQ(said_of("[1, NaN]"), no_json);
    EXPECT_EQ(said_of("3"), "'x' is not CityJSON 2.0" + give);
    EXPECT_EQ(said_of(std::string(100000, '[')),
              "'x' is nested deeper than any CityJSON of buildings" + give);
}

TEST(ReadCity, refusesAFileThatIsNotThere) {
    EXPECT_THROW(static_cast<void>(mesh::read_city("no such file")), InputError);
}

}  // namespace
}  // namespace d2b::test

#include "dem2buildings_mesh/mesh_text.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace d2b::test {
namespace {

using namespace mesh;

/// A roof and a piece of terrain, a step of a quarter of a metre.
class MeshText : public ::testing::Test {
  protected:
    MeshText() {
        frame_.scale = {0.25, 0.25, 0.001};
        frame_.translate = {1000, 2000, 0};
        frame_.origin = {1001, 2000, -1};
        city_.lod = "1.2";
        city_.reference_system = "https://www.opengis.net/def/crs/EPSG/0/25832";
        city_.buildings.push_back({"building_7", R"({"height":5})", {}, 0});
        shell_.points = {{0, 0, 1500}, {4, 0, 1500}, {0, 4, 1500}, {4, 4, 1500}};
        shell_.triangles = {{ShellPart::roof, 0, {0, 1, 2}}, {ShellPart::terrain, -1, {2, 1, 3}}};
    }
    [[nodiscard]] std::string text(void (*write)(const NamedShell&, const TextSink&)) const {
        std::string all;
        write({city_, frame_, shell_}, [&](const std::string& piece) { all += piece; });
        return all;
    }
    SurfaceFrame frame_;
    CityModel city_;
    Shell shell_;
};

TEST_F(MeshText, writesStl) {
    EXPECT_EQ(text(write_stl),
              "solid building_7 origin 1001 2000 -1\n"
              "facet normal 0 0 1\nouter loop\n"
              "vertex -1 0 2.5\nvertex 0 0 2.5\nvertex -1 1 2.5\nendloop\nendfacet\n"
              "endsolid building_7\n"
              "solid terrain origin 1001 2000 -1\n"
              "facet normal 0 0 1\nouter loop\n"
              "vertex -1 1 2.5\nvertex 0 0 2.5\nvertex 0 1 2.5\nendloop\nendfacet\n"
              "endsolid terrain\n");
}

TEST_F(MeshText, writesObj) {
    EXPECT_EQ(text(write_obj),
              "# dem2buildings_mesh: metres from the origin, x to the east, y to the north, z up\n"
              "# origin: 1001 2000 -1\n"
              "v -1 0 2.5\nv 0 0 2.5\nv -1 1 2.5\nv 0 1 2.5\n"
              "o building_7\ng roof\nf 1 2 3\no terrain\ng terrain\nf 3 2 4\n");
}

TEST_F(MeshText, writesCityJson) {
    const nlohmann::json city = nlohmann::json::parse(text(write_city_json));
    EXPECT_EQ(city["version"], "2.0");
    EXPECT_EQ(city["transform"]["scale"], (std::vector<double>{0.25, 0.25, 0.001}));
    EXPECT_EQ(city["metadata"]["geographicalExtent"],
              (std::vector<double>{1000, 2000, 1.5, 1001, 2001, 1.5}));
    EXPECT_EQ(city["metadata"]["referenceSystem"], city_.reference_system);
    EXPECT_EQ(city["vertices"][3], (std::vector<int>{4, 4, 1500}));
    const nlohmann::json& building = city["CityObjects"]["building_7"];
    EXPECT_EQ(building["attributes"]["height"], 5);
    EXPECT_EQ(building["geometry"][0]["type"], "MultiSurface");
    EXPECT_EQ(building["geometry"][0]["boundaries"], nlohmann::json::parse("[[[0,1,2]]]"));
    EXPECT_EQ(building["geometry"][0]["semantics"]["values"], (std::vector<int>{0}));
    EXPECT_EQ(city["CityObjects"]["terrain"]["type"], "TINRelief");
    EXPECT_EQ(city["CityObjects"]["terrain"]["geometry"][0]["boundaries"],
              nlohmann::json::parse("[[[2,1,3]]]"));
}

TEST_F(MeshText, writesPartsOfADividedBuilding) {
    city_.buildings.push_back({"building_9", "", {}, 0, "whole_7"});
    city_.buildings[0].whole = "whole_7";
    shell_.triangles.push_back({ShellPart::roof, 1, {2, 1, 3}});
    const nlohmann::json city = nlohmann::json::parse(text(write_city_json));
    EXPECT_EQ(city["CityObjects"]["whole_7"],
              nlohmann::json::parse(R"({"type":"Building","children":["building_7","building_9"]})"));
    for (const char* name : {"building_7", "building_9"}) {
        EXPECT_EQ(city["CityObjects"][name]["type"], "BuildingPart");
        EXPECT_EQ(city["CityObjects"][name]["parents"], nlohmann::json::array({"whole_7"}));
    }
}

/// Triangles that hang together by edges are one surface; a corner in common does not join two. The largest
/// comes first.
TEST_F(MeshText, writesAReliefPerConnectedPart) {
    shell_.points = {{0, 0, 0}, {4, 0, 0},  {0, 4, 0},  {4, 4, 0}, {8, 4, 0},
                     {8, 8, 0}, {20, 0, 0}, {24, 0, 0}, {20, 4, 0}};
    shell_.triangles = {{ShellPart::terrain, -1, {6, 7, 8}},
                        {ShellPart::terrain, -1, {0, 1, 2}},
                        {ShellPart::terrain, -1, {3, 4, 5}},
                        {ShellPart::terrain, -1, {2, 1, 3}}};
    const nlohmann::json city = nlohmann::json::parse(text(write_city_json));
    const auto boundaries = [&](const char* name) {
        return city["CityObjects"][name]["geometry"][0]["boundaries"];
    };
    ASSERT_EQ(city["CityObjects"].size(), 3U);
    EXPECT_EQ(boundaries("terrain"), nlohmann::json::parse("[[[0,1,2]],[[2,1,3]]]"));
    EXPECT_EQ(boundaries("terrain_2"), nlohmann::json::parse("[[[6,7,8]]]"));
    EXPECT_EQ(boundaries("terrain_3"), nlohmann::json::parse("[[[3,4,5]]]"));
    for (const char* name : {"terrain", "terrain_2", "terrain_3"})
        EXPECT_EQ(city["CityObjects"][name]["type"], "TINRelief");
}

}  // namespace
}  // namespace d2b::test

#include "write/surface/cityjson_sink.hpp"

#include <nlohmann/json.hpp>

#include "dem2buildings/error.hpp"
#include "write/surface_sink_case.hpp"

namespace d2b::test {
namespace {

class CityJsonSinkTest : public SurfaceSinkCase {
  protected:
    CityJsonSinkTest() {
        meta_.lod = "1.3";
        meta_.vertical_unit = "metre";
        meta_.fields = {{"id", "", FieldType::integer, "", ""},
                        {"height", "", FieldType::real, "", ""},
                        {"doubt", "", FieldType::text, "", ""}};
        meta_.provenance.crs_wkt = wkt_of(25832);
    }
    /// A box of 1 x 2 cells with a shaft, 3 m high.
    static SurfacePart solid(std::int64_t id, std::int64_t x) {
        SurfacePart part;
        for (const std::int64_t z : {0, 3000})
            for (const auto& [dx, dy] :
                 {std::pair(0, 0), std::pair(1024, 0), std::pair(1024, 2048), std::pair(0, 2048)})
                part.points.push_back({x + dx, dy, z});
        SurfaceBuilding building;
        building.id = id;
        building.values = {id, 3.5, std::monostate()};
        building.faces = {{FaceKind::roof, {4, 5, 6, 7}, {}},
                          {FaceKind::wall, {0, 1, 5, 4}, {}},
                          {FaceKind::wall, {1, 2, 6, 5}, {}},
                          {FaceKind::wall, {2, 3, 7, 6}, {{0, 1, 5}}},
                          {FaceKind::ground, {3, 2, 1, 0}, {}}};
        part.buildings.push_back(building);
        return part;
    }
    [[nodiscard]] nlohmann::json written() const { return nlohmann::json::parse(bytes("a.city.json")); }
};

TEST_F(CityJsonSinkTest, writesSolids) {
    const auto sink = open_cityjson_sink(place("a.city.json"));
    EXPECT_EQ(sink->form(), SurfaceForm::solids);
    sink->preflight(meta_);
    sink->begin(meta_);
    sink->add(solid(7, 0));
    sink->add(solid(12, 1024));  // beside it: four corners are those of both
    sink->end_group();
    sink->finish();
    EXPECT_EQ(entries(), Names{"a.city.json"});
    const auto expected = nlohmann::json::parse(R"({"type":"CityJSON","version":"2.0",
"transform":{"scale":[0.00048828125,0.00048828125,0.001],"translate":[1000.25,2000,0]},
"metadata":{"geographicalExtent":[1000.25,2000,0,1001.25,2001,3],
            "referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/25832"},
"CityObjects":{
 "building_7":{"type":"Building","attributes":{"id":7,"height":3.5,"doubt":null},
  "geometry":[{"type":"Solid","lod":"1.3",
   "boundaries":[[[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6],[0,1,5]],[[3,2,1,0]]]],
   "semantics":{"surfaces":[{"type":"RoofSurface"},{"type":"WallSurface"},{"type":"GroundSurface"}],
                "values":[[0,1,1,1,2]]}}]},
 "building_12":{"type":"Building","attributes":{"id":12,"height":3.5,"doubt":null},
  "geometry":[{"type":"Solid","lod":"1.3",
   "boundaries":[[[[5,10,11,6]],[[1,8,10,5]],[[8,9,11,10]],[[9,2,6,11],[1,8,10]],[[2,9,8,1]]]],
   "semantics":{"surfaces":[{"type":"RoofSurface"},{"type":"WallSurface"},{"type":"GroundSurface"}],
                "values":[[0,1,1,1,2]]}}]}},
"vertices":[[0,0,0],[1024,0,0],[1024,2048,0],[0,2048,0],[0,0,3000],[1024,0,3000],[1024,2048,3000],[0,2048,3000],
            [2048,0,0],[2048,2048,0],[2048,0,3000],[2048,2048,3000]]})");
    EXPECT_EQ(written(), expected) << written().dump();
}

/// A building that was divided has no geometry, and its parts have what a building has. Parts of others may
/// come between them.
TEST_F(CityJsonSinkTest, writesPartsOfADividedBuilding) {
    const auto sink = open_cityjson_sink(place("a.city.json"));
    sink->begin(meta_);
    for (const std::int64_t id : {3, 4, 5}) {
        SurfacePart part = solid(id, 1024 * id);
        part.buildings[0].whole = id == 4 ? 0 : 3;
        sink->add(part);
        sink->end_group();
    }
    sink->finish();
    const nlohmann::json objects = written()["CityObjects"];
    EXPECT_EQ(objects.size(), 4U);
    EXPECT_EQ(objects["whole_3"],
              nlohmann::json::parse(R"({"type":"Building","children":["building_3","building_5"]})"));
    EXPECT_EQ(objects["building_4"]["type"], "Building");
    EXPECT_FALSE(objects["building_4"].contains("parents"));
    for (const char* name : {"building_3", "building_5"}) {
        EXPECT_EQ(objects[name]["type"], "BuildingPart");
        EXPECT_EQ(objects[name]["parents"], nlohmann::json::array({"whole_3"}));
        EXPECT_EQ(objects[name]["attributes"]["height"], 3.5);
        EXPECT_EQ(objects[name]["geometry"][0]["type"], "Solid");
    }
}

/// A city without buildings is one, and so is one without a CRS.
TEST_F(CityJsonSinkTest, writesNoBuildings) {
    meta_.provenance.crs_wkt = "";
    const auto sink = open_cityjson_sink(place("a.city.json"));
    sink->preflight(meta_);
    sink->begin(meta_);
    sink->finish();
    EXPECT_EQ(written(),
              nlohmann::json::parse(R"({"type":"CityJSON","version":"2.0","CityObjects":{},"vertices":[],
"transform":{"scale":[0.00048828125,0.00048828125,0.001],"translate":[1000.25,2000,0]},"metadata":{}})"));
    EXPECT_EQ(sink->take_warnings(), Names{});
}

/// Parts wait in a file where they are many.
TEST_F(CityJsonSinkTest, writesManyBuildings) {
    constexpr int many = 20000;
    const auto sink = open_cityjson_sink(place("a.city.json"));
    sink->begin(meta_);
    for (int i = 0; i < many; ++i) {
        sink->add(solid(i, 1025 * i));
        sink->end_group();
    }
    sink->finish();
    const nlohmann::json city = written();
    EXPECT_EQ(city["CityObjects"].size(), many);
    ASSERT_EQ(city["vertices"].size(), 8U * many);
    for (int i = 0; i < many; i += 777) {
        const auto first = static_cast<std::size_t>(8 * i);
        EXPECT_EQ(city["vertices"][first], (nlohmann::json{1025 * i, 0, 0}));
        const auto& solid = city["CityObjects"]["building_" + std::to_string(i)]["geometry"][0]["boundaries"];
        EXPECT_EQ(solid[0][0][0], (nlohmann::json{first + 4, first + 5, first + 6, first + 7}));
    }
}

TEST_F(CityJsonSinkTest, saysWhereACrsHasNoCode) {
    meta_.provenance.crs_wkt = "+proj=tmerc +lat_0=1 +lon_0=9 +ellps=GRS80 +type=crs";
    const auto sink = open_cityjson_sink(place("a.city.json"));
    sink->begin(meta_);
    sink->finish();
    EXPECT_EQ(sink->take_warnings(), Names{"A CityJSON names its CRS by the code of an authority, and "
                                           "'unknown' has none; the file does not say "
                                           "what its CRS is."});
    EXPECT_FALSE(written()["metadata"].contains("referenceSystem"));
}

/// A GeoTIFF keeps the codes of the parts, and the file names the pair; what has no number is warned of.
TEST_F(CityJsonSinkTest, namesTheDatumOfTheHeights) {
    const auto written_of = [&](const char* crs, Names warnings) {
        meta_.provenance.crs_wkt = crs;
        std::filesystem::remove(path("a.city.json"));
        const auto sink = open_cityjson_sink(place("a.city.json"));
        sink->begin(meta_);
        sink->finish();
        EXPECT_EQ(sink->take_warnings(), warnings) << crs;
        return written()["metadata"]["referenceSystem"].get<std::string>();
    };
    EXPECT_EQ(written_of("EPSG:28992+5709", {}), "https://www.opengis.net/def/crs/EPSG/0/7415");
    EXPECT_EQ(
        written_of("EPSG:25832+7837",
                   {"A CityJSON names its CRS by the code of an authority, and 'ETRS89 / UTM zone 32N + "
                    "DHHN2016 height' has none; the file names only the horizontal part, and does not "
                    "say where its heights begin."}),
        "https://www.opengis.net/def/crs/EPSG/0/25832");
}

TEST_F(CityJsonSinkTest, refusesTwoUnits) {
    const auto sink = open_cityjson_sink(place("a.city.json"));
    meta_.frame.vertical_metres = 0.3048;
    meta_.vertical_unit = "foot";
    EXPECT_EQ(thrown<OptionError>([&] { sink->preflight(meta_); }),
              "CityJSON has heights in the unit of x and y, which is the metre in 'ETRS89 / UTM zone 32N', "
              "and the elevations are in the unit 'foot'; give a CRS in that unit with -t_srs, or their true "
              "unit with -zunit.");
    meta_.frame.horizontal_metres = 0.3048;
    sink->preflight(meta_);
    meta_.vertical_unit = "";
    EXPECT_EQ(thrown<OptionError>([&] { sink->preflight(meta_); }),
              "CityJSON has heights in the unit of x and y, and the unit of the elevations is unknown; give "
              "it with -zunit and, if x and y have another unit, a CRS in that unit with -t_srs.");
}

}  // namespace
}  // namespace d2b::test

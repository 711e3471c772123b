#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/number_from_chars.hpp"
#include "dem2buildings/error.hpp"
#include "write/surface/cityjson_sink.hpp"
#include "write/surface/glb_sink.hpp"
#include "write/surface/obj_stl_sink.hpp"
#include "write/surface/surface_sink.hpp"
#include "write/surface_sink_case.hpp"

namespace d2b::writing {
namespace {

using namespace test;

/// Sinks of each format.
class EachSurfaceSink : public SurfaceSinkCase, public ::testing::WithParamInterface<std::string> {
  protected:
    [[nodiscard]] std::unique_ptr<SurfaceSink> open(bool overwrite = false) const {
        return open_surface_sink(resolve_surface_target({path(GetParam()), overwrite, {}, FileKind::surface}),
                                 SurfaceSolids::each);
    }
};

INSTANTIATE_TEST_SUITE_P(Formats, EachSurfaceSink,
                         ::testing::Values("a.city.json", "a.glb", "a.obj", "a.stl"));

/// Nothing is left of one that is not finished, however much was written.
TEST_P(EachSurfaceSink, isThereWholeOrNotAtAll) {
    {
        const auto sink = open();
        sink->begin(meta_);
        for (int i = 0; i < 20000; ++i)
            sink->add(part(i));
        EXPECT_LE(entries().size(), 2U);  // hidden folders
    }
    EXPECT_EQ(entries(), Names{});
}

TEST_P(EachSurfaceSink, aFileThatHasChangedMeanwhileIsLeftAlone) {
    const auto sink = open();
    put(GetParam(), "of somebody else");
    sink->begin(meta_);
    sink->add(part(1));
    EXPECT_NE(thrown<OutputError>([&] { sink->finish(); }).find(GetParam()), std::string::npos);
    EXPECT_EQ(bytes(GetParam()), "of somebody else");
}

/// The materials of an OBJ stand in a file beside it, which is replaced with it and by nothing else.
TEST_F(SurfaceSinkCase, materialsGoWithTheirObj) {
    const auto located = [&](bool overwrite) {
        return resolve_surface_target({path("a.obj"), overwrite, {}, FileKind::surface});
    };
    EXPECT_FALSE(resolve_surface_target({path("a.stl"), false, {}, FileKind::surface}).materials);
    put("a.mtl", "Dear diary\n");
    EXPECT_EQ(thrown<OptionError>([&] { static_cast<void>(located(false)); }),
              "\"" + path("a.mtl") + "\" exists; give another name, or -overwrite to replace it.");
    EXPECT_EQ(thrown<OptionError>([&] { static_cast<void>(located(true)); }),
              "\"" + path("a.mtl") + "\" exists and is not a material library (MTL); remove it first.");
    put("a.mtl", "# by hand\nnewmtl red\n");
    const auto sink = open_surface_sink(located(true), SurfaceSolids::each);
    sink->begin(meta_);
    sink->add(part(1));
    EXPECT_EQ(bytes("a.mtl"), "# by hand\nnewmtl red\n");
    sink->finish();
    EXPECT_NE(bytes("a.mtl").find("newmtl roof"), std::string::npos);
    EXPECT_EQ(entries(), (Names{"a.mtl", "a.obj"}));
}

TEST(SurfaceFormats, materialsHaveTheNameOfTheirObj) {
    EXPECT_EQ(mtl_name("a/b.c/Town 1.OBJ"), "a/b.c/Town 1.mtl");
    // A line of an OBJ would end there, or go on on the next one.
    EXPECT_EQ(mtl_name("a\\b/a\nb\\.obj"), "a\\b/a_b_.mtl");
    EXPECT_TRUE(looks_like_mtl("# x\n\nnewmtl a\n"));
    EXPECT_FALSE(looks_like_mtl("Kd 1 0 0\n"));
}

TEST(SurfaceFormats, byTheEndOfAName) {
    EXPECT_EQ(surface_format_of("a/b.obj"), SurfaceFormat::obj);
    EXPECT_EQ(surface_format_of("B.OBJ"), SurfaceFormat::obj);
    EXPECT_EQ(surface_format_of("a.city.json"), SurfaceFormat::cityjson);
    EXPECT_EQ(surface_format_of("A.City.JSON"), SurfaceFormat::cityjson);
    EXPECT_EQ(surface_format_of("a.json"), std::nullopt);
    EXPECT_EQ(surface_format_of("a.stl"), SurfaceFormat::stl);
    EXPECT_EQ(surface_format_of("a.GLB"), SurfaceFormat::glb);
    EXPECT_EQ(surface_format_of("obj"), std::nullopt);
    EXPECT_EQ(surface_format_of("a.obj.gz"), std::nullopt);
}

TEST(SurfaceFormats, whatMayBeReplaced) {
    const auto is_obj = [](const char* text) { return looks_like_surface(SurfaceFormat::obj, text); };
    EXPECT_TRUE(is_obj("# of another program\n\nmtllib a.mtl\n"));
    EXPECT_TRUE(is_obj("v 1 2 3\n"));
    EXPECT_TRUE(is_obj("o\tone\r\n"));
    EXPECT_TRUE(is_obj("# a comment alone"));
    EXPECT_TRUE(is_obj(""));
    EXPECT_FALSE(is_obj("vertex 1 2 3\n"));
    EXPECT_FALSE(is_obj("# a\nDear diary\n"));
}

TEST(SurfaceFormats, whatMayBeReplacedOfOtherFormats) {
    EXPECT_TRUE(looks_like_surface(SurfaceFormat::stl, "solid of another program\n facet"));
    EXPECT_FALSE(looks_like_surface(SurfaceFormat::stl, "Dear diary, a solid day\n"));
    EXPECT_TRUE(looks_like_surface(SurfaceFormat::glb, "glTF\2"));
    EXPECT_FALSE(looks_like_surface(SurfaceFormat::glb, "{\"asset\":"));
    const auto is_city = [](const char* text) { return looks_like_surface(SurfaceFormat::cityjson, text); };
    EXPECT_TRUE(is_city("\n{ \"type\" : \"CityJSON\", "));
    EXPECT_TRUE(is_city("{\"version\": \"1.1\", \"type\": \"CityJSON\""));
    EXPECT_FALSE(is_city("{\"type\": \"FeatureCollection\""));
    EXPECT_FALSE(is_city("\"CityJSON\""));
    EXPECT_FALSE(is_city(""));
}

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

/// A building that was divided has no geometry, because its parts have it. Parts of others may
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

/// A GeoTIFF keeps the codes of the parts, and the file names the pair; a CRS without a number is warned of.
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

class GlbSinkTest : public SurfaceSinkCase {
  protected:
    GlbSinkTest() {
        meta_.fields = {{"id", "", FieldType::integer, "", ""}, {"height", "", FieldType::real, "", ""}};
        meta_.provenance.crs_wkt = wkt_of(25832);
    }
    /// Little-endian numbers of four bytes: whole ones, or floats.
    template <typename T>
    static std::vector<T> numbers(std::string bytes) {
        if constexpr (std::endian::native == std::endian::big)
            for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4)
                std::reverse(bytes.data() + i, bytes.data() + i + 4);
        std::vector<T> all(bytes.size() / sizeof(T));
        std::memcpy(all.data(), bytes.data(), bytes.size());
        return all;
    }
};

TEST_F(GlbSinkTest, writesAPrimitiveAMaterial) {
    const auto sink = open_glb_sink(place("a.glb"));
    EXPECT_EQ(sink->form(), SurfaceForm::shell);
    sink->begin(meta_);
    SurfacePart two = part(7);
    two.buildings[0].values = {std::int64_t{7}, 12.5};
    two.buildings[1].values = {std::int64_t{8}, std::monostate()};
    sink->add(two);
    EXPECT_FALSE(std::filesystem::exists(path("a.glb")));
    sink->finish();
    EXPECT_EQ(entries(), Names{"a.glb"});
    const std::string all = bytes("a.glb");
    const auto header = numbers<std::uint32_t>(all.substr(0, 20));
    EXPECT_EQ(all.substr(0, 4) + all.substr(16, 4), "glTFJSON");
    EXPECT_EQ(header[1], 2U);
    EXPECT_EQ(header[2], all.size());
    const std::size_t json_size = header[3];
    EXPECT_EQ(json_size % 4, 0U);
    const auto expected = nlohmann::json::parse(R"({
"asset":{"version":"2.0","generator":"dem2buildings",
         "extras":{"origin":[1000,2010,7],"crs":"ETRS89 / UTM zone 32N","D2B_SOURCE":"a\nb\\.tif"}},
"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"name":"buildings","mesh":0,"extras":{"buildings":[
           {"name":"building_7","attributes":{"id":7,"height":12.5}},
           {"name":"building_8","attributes":{"id":8,"height":null}}]}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"_FEATURE_ID_0":1},"indices":2,"material":0},
                         {"attributes":{"POSITION":0,"_FEATURE_ID_0":1},"indices":3,"material":1},
                         {"attributes":{"POSITION":0,"_FEATURE_ID_0":1},"indices":4,"material":2}]}],
"buffers":[{"byteLength":160}],
"bufferViews":[{"buffer":0,"byteLength":84,"byteStride":12,"target":34962},
               {"buffer":0,"byteOffset":84,"byteLength":28,"byteStride":4,"target":34962},
               {"buffer":0,"byteOffset":112,"byteLength":48,"target":34963}]})");
    const auto json = nlohmann::json::parse(all.substr(20, json_size));
    for (const auto& [name, value] : expected.items())
        EXPECT_EQ(json[name], value) << json[name].dump();
    ASSERT_EQ(json["accessors"].size(), 5U);
    EXPECT_EQ(json["accessors"][0], nlohmann::json::parse(R"({"bufferView":0,"componentType":5126,
"count":7,"type":"VEC3","min":[0.25,0,9],"max":[0.75,0.25,10]})"));
    EXPECT_EQ(json["accessors"][1],
              nlohmann::json::parse(R"({"bufferView":1,"componentType":5126,"count":7,"type":"SCALAR"})"));
    EXPECT_EQ(json["accessors"][4],
              nlohmann::json::parse(
                  R"({"bufferView":2,"byteOffset":36,"componentType":5125,"count":3,"type":"SCALAR"})"));
    EXPECT_EQ(json["materials"].size(), 3U);
    // y is up, z to the south.
    const std::string bin = all.substr(20 + json_size + 8);
    EXPECT_EQ(numbers<float>(bin.substr(0, 36)),
              (std::vector<float>{0.25F, 0, 10, 0.75F, 0, 10, 0.25F, 0.25F, 9}));
    // Four corners of the first building, three of the second, and their triangles by kind.
    EXPECT_EQ(numbers<float>(bin.substr(84, 28)), (std::vector<float>{0, 0, 0, 0, 1, 1, 1}));
    EXPECT_EQ(numbers<std::uint32_t>(bin.substr(112)),
              (std::vector<std::uint32_t>{4, 6, 5, 0, 1, 3, 1, 2, 3, 0, 2, 1}));
}

/// The scene needs something to show.
TEST_F(GlbSinkTest, writesNoFileWithoutBuildings) {
    const auto sink = open_glb_sink(place("a.glb"));
    sink->begin(meta_);
    sink->finish();
    EXPECT_EQ(sink->take_warnings(),
              Names{"There is no building for \"" + path("a.glb") +
                    "\", and a glTF without a mesh shows nothing; no file is written."});
    EXPECT_EQ(entries(), Names{});
}

/// Lengths have 32 bits.
TEST_F(GlbSinkTest, refusesWhatIsTooLong) {
    const std::string too_long =
        "\"" + path("a.glb") +
        "\" would be longer than the 1500 bytes that a .glb can have; use a smaller window "
        "(-srcwin, -projwin or -te), or write an OBJ.";
    const auto at_once = open_glb_sink(place("a.glb"), 1500);
    at_once->begin(meta_);
    for (int i = 0; i < 9; ++i)
        at_once->add(part(2 * i));
    EXPECT_EQ(thrown<OutputError>([&] { at_once->add(part(18)); }), too_long);
    const auto in_the_end = open_glb_sink(place("a.glb"), 1500);
    in_the_end->begin(meta_);
    in_the_end->add(part(1));
    EXPECT_EQ(thrown<OutputError>([&] { in_the_end->finish(); }), too_long);
    EXPECT_EQ(entries(), Names{});
}

using ObjSinkTest = SurfaceSinkCase;

TEST_F(ObjSinkTest, writesObjectsWithGroups) {
    const auto sink = open_obj_sink(place("a.obj"), materials("a.mtl"));
    EXPECT_EQ(sink->form(), SurfaceForm::shell);
    sink->begin(meta_);
    sink->add(part(7));
    sink->add(part(12));
    EXPECT_FALSE(std::filesystem::exists(path("a.obj")));
    sink->finish();
    EXPECT_EQ(entries(), (Names{"a.mtl", "a.obj"}));
    const std::string corners = "v 0.25 -10 0\nv 0.75 -10 0\nv 0.25 -9 0.25\nv 0.25048828125 -10 0.001\n";
    const std::string roof = "g roof\nusemtl roof\n";
    const std::string wall = "g wall\nusemtl wall\n";
    const std::string ground = "g ground\nusemtl ground\n";
    EXPECT_EQ(bytes("a.obj"),
              "# dem2buildings: metres from the origin, x to the east, y to the north, z up\n"
              "# origin: 1000 2010 7\n"
              "# D2B_SOURCE: a b .tif\n"
              "mtllib a.mtl\n" +
                  corners + "o building_7\n" + roof + wall + "f 1 2 4\nf 2 3 4\n" + ground +
                  "f 1 3 2\no building_8\n" + roof + "f 1 4 3\n" + wall + ground + corners +
                  "o building_12\n" + roof + wall + "f 5 6 8\nf 6 7 8\n" + ground +
                  "f 5 7 6\no building_13\n" + roof + "f 5 8 7\n" + wall + ground);
    EXPECT_EQ(bytes("a.mtl"),
              "# dem2buildings\n"
              "newmtl roof\nKd 0.45 0.09 0.05\nillum 1\n"
              "newmtl wall\nKd 0.6 0.57 0.5\nillum 1\n"
              "newmtl ground\nKd 0.2 0.2 0.2\nillum 1\n");
}

TEST_F(ObjSinkTest, writesOneObjectForAll) {
    const auto sink = open_obj_sink(place("a.obj"), materials("a.mtl"), SurfaceSolids::one);
    sink->begin(meta_);
    sink->add(part(7));
    sink->add(part(12));
    sink->finish();
    const std::string all = bytes("a.obj");
    EXPECT_NE(all.find("\no buildings\n"), std::string::npos);
    EXPECT_EQ(all.find("\no "), all.rfind("\no "));
    EXPECT_NE(all.find("\nf 5 8 7\n"), std::string::npos);
}

TEST_F(ObjSinkTest, namesTheCrs) {
    meta_.provenance = {wkt_of(25832), {}};
    const auto sink = open_obj_sink(place("a.obj"), materials("a.mtl"));
    sink->begin(meta_);
    sink->finish();
    EXPECT_NE(bytes("a.obj").find("# crs: ETRS89 / UTM zone 32N\n"), std::string::npos);
}

using StlSinkTest = SurfaceSinkCase;

TEST_F(StlSinkTest, writesASolidABuilding) {
    const auto sink = open_stl_sink(place("a.stl"));
    EXPECT_EQ(sink->form(), SurfaceForm::shell);
    sink->begin(meta_);
    sink->add(part(7));
    EXPECT_FALSE(std::filesystem::exists(path("a.stl")));
    sink->finish();
    EXPECT_EQ(entries(), Names{"a.stl"});
    const std::string lines = bytes("a.stl");
    const std::string begin =
        "solid building_7 origin 1000 2010 7\n"
        "facet normal 0 0.242536 -0.970143\n"
        "outer loop\nvertex 0.25 -10 0\nvertex 0.25 -9 0.25\nvertex 0.75 -10 0\nendloop\nendfacet\n";
    EXPECT_EQ(lines.substr(0, begin.size()), begin);
    EXPECT_NE(lines.find("endsolid building_7\nsolid building_8 origin 1000 2010 7\n"), std::string::npos);
    EXPECT_TRUE(lines.ends_with("endloop\nendfacet\nendsolid building_8\n"));
}

TEST_F(StlSinkTest, writesOneSolidForAll) {
    const auto sink = open_stl_sink(place("a.stl"), SurfaceSolids::one);
    sink->begin(meta_);
    sink->add(part(7));
    sink->add(part(12));
    sink->finish();
    const std::string lines = bytes("a.stl");
    EXPECT_TRUE(lines.starts_with("solid buildings origin 1000 2010 7\nfacet"));
    EXPECT_TRUE(lines.ends_with("endfacet\nendsolid buildings\n"));
    EXPECT_EQ(lines.find("solid", 5), lines.rfind("endsolid") + 3);
}

/// An STL cannot hold nothing.
TEST_F(StlSinkTest, writesNoFileWithoutBuildings) {
    for (const bool replaces : {false, true}) {
        if (replaces)
            put("a.stl", "solid of another\n");
        const auto sink = open_stl_sink(place("a.stl", true));
        sink->begin(meta_);
        sink->finish();
        EXPECT_EQ(sink->take_warnings(),
                  Names{"There is no building for \"" + path("a.stl") +
                        "\", and an STL needs a solid; no file is written" +
                        std::string(replaces ? ", and the old one stays as it was." : ".")});
        EXPECT_EQ(entries(), replaces ? Names{"a.stl"} : Names{});
    }
    EXPECT_EQ(bytes("a.stl"), "solid of another\n");
}

}  // namespace
}  // namespace d2b::writing

namespace d2b::writing {
namespace {

/// Reads a number with a point, whatever the locale says.
float first_number(const std::string& text) {
    float number = 0;
    number_from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

/// Neighbouring steps stay apart in single precision, as far out as the lattice allows.
TEST(LocalCoordinateFormatter, tellsStepsApart) {
    for (const double cell : {0.1, 0.25, 0.5, 1.0, 2.5, 30.0}) {
        SurfaceFrame frame;
        frame.scale = {cell / 1024, cell / 1024, 0.001};
        frame.translate = {0.3, 0.7, 0};
        const LocalCoordinateFormatter text(frame);
        for (const std::int64_t x : {std::int64_t{0}, std::int64_t{12345}, std::int64_t{8191} * 1024})
            for (std::int64_t step = 0; step < 64; ++step) {
                const float here = first_number(text({x + step, 0, 0}));
                const float next = first_number(text({x + step + 1, 0, 0}));
                EXPECT_LT(here, next) << cell << " " << x;
            }
    }
}

TEST(LocalCoordinateFormatter, hasNoMoreDigitsThanItNeeds) {
    SurfaceFrame frame;
    frame.scale = {1 / 1024.0, 1 / 1024.0, 0.001};
    const LocalCoordinateFormatter text(frame);
    EXPECT_EQ(text({0, 0, 0}), "0 0 0");
    EXPECT_EQ(text({-1024, 512, -1500}), "-1 0.5 -1.5");
    EXPECT_EQ(text({1, -1, 1}), "0.0009765625 -0.0009765625 0.001");
    frame.horizontal_metres = 0.3048;
    frame.origin = {100, 0, -2};
    EXPECT_EQ(origin_text(frame), "100 0 -2");
    EXPECT_EQ(LocalCoordinateFormatter(frame)({1024 * 1000, 0, 0}), "204.8 0 2");
}

/// Three corners in a line are in a line as they are written: the text has all decimals, wherever the raster
/// lies.
TEST(LocalCoordinateFormatter, roundsNothing) {
    SurfaceFrame frame;
    frame.scale = {0.4 / 1024, 0.4 / 1024, 0.001};
    frame.translate = {391000.1, 5820000.3, 0};
    frame.origin = {391000, 5820000, 0};
    const LocalCoordinateFormatter text(frame);
    EXPECT_EQ(text({0, 0, 0}), "0.1 0.3 0");
    EXPECT_EQ(text({1, 3, 0}), "0.100390625 0.301171875 0");
    EXPECT_EQ(text({7'000'001, 21'000'003, 0}), "2734.475390625 8203.426171875 0");
}

/// Feet have more than any reader tells apart.
TEST(LocalCoordinateFormatter, roundsFeet) {
    SurfaceFrame frame;
    frame.scale = {1 / 1024.0, 1 / 1024.0, 0.001};
    frame.horizontal_metres = 1200.0 / 3937;
    EXPECT_EQ(LocalCoordinateFormatter(frame)({1, 2, 0}), "0.0003 0.0006 0");
}

}  // namespace
}  // namespace d2b::writing

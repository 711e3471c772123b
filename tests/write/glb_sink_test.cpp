#include "write/surface/glb_sink.hpp"

#include <cstring>

#include <nlohmann/json.hpp>

#include "dem2buildings/error.hpp"
#include "write/surface_sink_case.hpp"

namespace d2b::test {
namespace {

class GlbSinkTest : public SurfaceSinkCase {
  protected:
    GlbSinkTest() {
        meta_.fields = {{"id", "", FieldType::integer, "", ""}, {"height", "", FieldType::real, "", ""}};
        meta_.provenance.crs_wkt = wkt_of(25832);
    }
    /// Whole numbers of four bytes, or what has single precision in them.
    template <typename T>
    static std::vector<T> numbers(const std::string& bytes) {
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

}  // namespace
}  // namespace d2b::test

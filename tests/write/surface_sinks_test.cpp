#include <optional>

#include "dem2buildings/error.hpp"
#include "write/surface/surface_sink.hpp"
#include "write/surface_sink_case.hpp"

namespace d2b::test {
namespace {

/// Of each format.
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

}  // namespace
}  // namespace d2b::test

#include "write/surface/obj_stl_sink.hpp"
#include "write/surface_sink_case.hpp"

namespace d2b::test {
namespace {

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
}  // namespace d2b::test

#include "write/surface/obj_stl_sink.hpp"
#include "write/surface_sink_case.hpp"

namespace d2b::test {
namespace {

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

}  // namespace
}  // namespace d2b::test

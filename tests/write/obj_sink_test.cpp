#include "write/obj_sink.hpp"

#include "write/surface_sink_case.hpp"

namespace d2b::test {
namespace {

using ObjSinkTest = SurfaceSinkCase;

TEST_F(ObjSinkTest, writesObjectsWithGroups) {
    const auto sink = open_obj_sink(place("a.obj"));
    EXPECT_EQ(sink->form(), SurfaceForm::shell);
    sink->begin(meta_);
    sink->add(part(7));
    sink->add(part(12));
    EXPECT_FALSE(std::filesystem::exists(path("a.obj")));
    sink->finish();
    EXPECT_EQ(entries(), Names{"a.obj"});
    const std::string corners = "v 0.25 -10 0\nv 0.75 -10 0\nv 0.25 -9 0.25\nv 0.25048828125 -10 0.001\n";
    EXPECT_EQ(bytes("a.obj"),
              "# dem2buildings: metres from the origin, x to the east, y to the north, z up\n"
              "# origin: 1000 2010 7\n"
              "# D2B_SOURCE: a b .tif\n" +
                  corners +
                  "o building_7\ng roof\ng wall\nf 1 2 4\nf 2 3 4\ng ground\nf 1 3 2\n"
                  "o building_8\ng roof\nf 1 4 3\ng wall\ng ground\n" +
                  corners +
                  "o building_12\ng roof\ng wall\nf 5 6 8\nf 6 7 8\ng ground\nf 5 7 6\n"
                  "o building_13\ng roof\nf 5 8 7\ng wall\ng ground\n");
}

TEST_F(ObjSinkTest, namesTheCrs) {
    meta_.provenance = {wkt_of(25832), {}};
    const auto sink = open_obj_sink(place("a.obj"));
    sink->begin(meta_);
    sink->finish();
    EXPECT_NE(bytes("a.obj").find("# crs: ETRS89 / UTM zone 32N\n"), std::string::npos);
}

}  // namespace
}  // namespace d2b::test

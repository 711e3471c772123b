#include "write/obj_sink.hpp"

#include <charconv>

#include "dem2buildings/error.hpp"
#include "write/coordinate_text.hpp"
#include "write/surface_format.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {
namespace {

using Names = std::vector<std::string>;

class ObjSinkTest : public WriteTest {
  protected:
    ObjSinkTest() {
        meta_.frame.scale = {0.5 / 1024, 0.5 / 1024, 0.001};
        meta_.frame.translate = {1000.25, 2000, 0};
        meta_.frame.origin = {1000, 2010, 7};
        meta_.provenance.metadata = {{"D2B_SOURCE", "a\nb\\.tif"}};
    }
    [[nodiscard]] RasterPlace place(const std::string& name) const {
        return locate_raster({path(name), false, {}, RasterFormat::surface});
    }
    /// Half of a tetrahedron, in two buildings: what is in it is not looked at.
    static SurfacePart part(std::int64_t id) {
        SurfacePart part;
        part.points = {{0, 0, 7000}, {1024, 0, 7000}, {0, 2048, 7250}, {1, 0, 7001}};
        part.buildings.resize(2);
        part.buildings[0].id = id;
        part.buildings[0].triangles = {
            {FaceKind::ground, {0, 2, 1}}, {FaceKind::wall, {0, 1, 3}}, {FaceKind::wall, {1, 2, 3}}};
        part.buildings[1].id = id + 1;
        part.buildings[1].triangles = {{FaceKind::roof, {0, 3, 2}}};
        return part;
    }

    SurfaceMeta meta_;
};

TEST_F(ObjSinkTest, writesObjectsWithGroups) {
    const auto sink = open_obj_sink(place("a.obj"));
    EXPECT_EQ(sink->form(), SurfaceForm::shell);
    sink->begin(meta_);
    sink->add(part(7));
    sink->add(part(12));
    EXPECT_FALSE(std::filesystem::exists(path("a.obj")));
    sink->finish();
    EXPECT_EQ(entries(), Names{"a.obj"});
    const std::string corners = "v 0.25 -10 0\nv 0.75 -10 0\nv 0.25 -9 0.25\nv 0.25049 -10 0.001\n";
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

/// Nothing is left of one that is not finished, however much was written.
TEST_F(ObjSinkTest, isThereWholeOrNotAtAll) {
    {
        const auto sink = open_obj_sink(place("a.obj"));
        sink->begin(meta_);
        for (int i = 0; i < 20000; ++i)
            sink->add(part(i));
        EXPECT_EQ(entries().size(), 1U);  // a hidden folder
    }
    EXPECT_EQ(entries(), Names{});
}

TEST_F(ObjSinkTest, aFileThatHasChangedMeanwhileIsLeftAlone) {
    const auto sink = open_obj_sink(place("a.obj"));
    put("a.obj", "of somebody else");
    sink->begin(meta_);
    EXPECT_NE(thrown<OutputError>([&] { sink->finish(); }).find("a.obj"), std::string::npos);
    EXPECT_EQ(bytes("a.obj"), "of somebody else");
}

/// With a point, whatever the locale says.
float first_number(const std::string& text) {
    float number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

/// Neighbouring steps stay apart in single precision, as far out as the lattice allows.
TEST(CoordinateText, tellsStepsApart) {
    for (const double cell : {0.1, 0.25, 0.5, 1.0, 2.5, 30.0}) {
        SurfaceFrame frame;
        frame.scale = {cell / 1024, cell / 1024, 0.001};
        frame.translate = {0.3, 0.7, 0};
        const CoordinateText text(frame);
        for (const std::int64_t x : {std::int64_t{0}, std::int64_t{12345}, std::int64_t{8191} * 1024})
            for (std::int64_t step = 0; step < 64; ++step) {
                const float here = first_number(text({x + step, 0, 0}));
                const float next = first_number(text({x + step + 1, 0, 0}));
                EXPECT_LT(here, next) << cell << " " << x;
            }
    }
}

TEST(CoordinateText, hasNoMoreDigitsThanItNeeds) {
    SurfaceFrame frame;
    frame.scale = {1 / 1024.0, 1 / 1024.0, 0.001};
    const CoordinateText text(frame);
    EXPECT_EQ(text({0, 0, 0}), "0 0 0");
    EXPECT_EQ(text({-1024, 512, -1500}), "-1 0.5 -1.5");
    EXPECT_EQ(text({1, -1, 1}), "0.00098 -0.00098 0.001");
    frame.horizontal_metres = 0.3048;
    frame.origin = {100, 0, -2};
    EXPECT_EQ(origin_text(frame), "100 0 -2");
    EXPECT_EQ(CoordinateText(frame)({1024 * 1000, 0, 0}), "204.8 0 2");
}

TEST(SurfaceFormats, byTheEndOfAName) {
    EXPECT_EQ(surface_format_of("a/b.obj"), SurfaceFormat::obj);
    EXPECT_EQ(surface_format_of("B.OBJ"), SurfaceFormat::obj);
    EXPECT_EQ(surface_format_of("obj"), std::nullopt);
    EXPECT_EQ(surface_format_of("a.obj.gz"), std::nullopt);
}

TEST(SurfaceFormats, whatMayBeReplaced) {
    const auto is_obj = [](const char* text) { return begins_a_surface(SurfaceFormat::obj, text); };
    EXPECT_TRUE(is_obj("# of another program\n\nmtllib a.mtl\n"));
    EXPECT_TRUE(is_obj("v 1 2 3\n"));
    EXPECT_TRUE(is_obj("o\tone\r\n"));
    EXPECT_TRUE(is_obj("# a comment alone"));
    EXPECT_TRUE(is_obj(""));
    EXPECT_FALSE(is_obj("vertex 1 2 3\n"));
    EXPECT_FALSE(is_obj("# a\nDear diary\n"));
}

}  // namespace
}  // namespace d2b::test

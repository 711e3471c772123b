#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/option_effect.hpp"
#include "cli/read_obj.hpp"
#include "cli/town_errors.hpp"
#include "cli/town_files.hpp"

namespace d2b::test {
namespace {

using Names = std::vector<std::string>;

/// A layer of a user's own in a GeoPackage, with one feature.
void add_notes(const std::string& path) {
    const OpenDataset dataset(
        GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE, nullptr, nullptr, nullptr));
    OGRLayerH layer = GDALDatasetCreateLayer(dataset.get(), "notes", nullptr, wkbNone, nullptr);
    OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(layer));
    EXPECT_EQ(OGR_L_CreateFeature(layer, feature), OGRERR_NONE);
    OGR_F_Destroy(feature);
}

}  // namespace

TEST_F(OptionEffect, layers) {
    trace({"-layers", "both"});
    EXPECT_EQ(layer_names(path("out.gpkg")), (Names{"buildings", "contours"}));
    run_well({"-layers", "buildings", "-q", "-fl", "5", "--", "blocks.tif", "b.gpkg"});
    EXPECT_EQ(layer_names(path("b.gpkg")), Names{"buildings"});
    run_well({"-layers", "contours", "-q", "-fl", "5", "--", "blocks.tif", "c.gpkg"});
    EXPECT_EQ(layer_names(path("c.gpkg")), Names{"contours"});
    EXPECT_EQ(layer("c.gpkg", "contours").records.size(), 3U);
}

TEST_F(OptionEffect, t_srs) {
    trace({});
    const double area = buildings().where("id", 1).number("area_m2");
    trace({"-t_srs", "EPSG:4326", "-overwrite"});
    EXPECT_EQ(buildings().crs, "WGS 84");
    const OGREnvelope box = buildings().where("id", 1).box();
    // x = 391 km in zone 33 (15 degrees east) is 109 km west of its middle: -1.595 degrees at 52.5 north.
    EXPECT_NEAR(box.MinX, 15 - 109e3 / 0.9996 / (111320 * std::cos(52.52 * M_PI / 180)), 0.01);
    EXPECT_NEAR(box.MinY, 52.52, 0.01);
    EXPECT_NEAR(box.MaxY - box.MinY, 7 / 111270.0, 0.25 / 111270);
    EXPECT_DOUBLE_EQ(buildings().where("id", 1).number("area_m2"), area);
}

TEST_F(OptionEffect, 3d) {
    trace({});
    EXPECT_EQ(contours().type, wkbMultiPolygon);
    trace({"-3d", "-overwrite"});
    EXPECT_EQ(contours().type, wkbMultiPolygon25D);
    for (const Record& record : contours().records) {
        OGREnvelope3D box{};
        OGR_G_GetEnvelope3D(record.geometry(), &box);
        EXPECT_EQ(box.MinZ, record.number("threshold"));
        EXPECT_EQ(box.MaxZ, record.number("threshold"));
    }
    OGREnvelope3D box{};
    OGR_G_GetEnvelope3D(buildings().records[0].geometry(), &box);
    EXPECT_EQ(box.MinZ, 5);
}

TEST_F(OptionEffect, f) {
    for (const char* name : {"-f", "-of", "-output_format"}) {
        const std::string file = std::string("out") + name + ".any";
        run_well({"-q", "-fl", "5", "-layers", "buildings", name, "GeoJSON", "blocks.tif", file});
        EXPECT_EQ(read_bytes(path(file)).substr(0, 1), "{");
        const OpenDataset dataset = open_vector(path(file));
        EXPECT_STREQ(GDALGetDriverShortName(GDALGetDatasetDriver(dataset.get())), "GeoJSON");
    }
}

TEST_F(OptionEffect, dsco) {
    for (const char* name : {"-dsco", "-co"}) {
        trace({name, "VERSION=1.3"});
        EXPECT_EQ(sql_value(path("out.gpkg"), "PRAGMA user_version"), "10300");
        std::filesystem::remove(path("out.gpkg"));
    }
    trace({"-dsco", "VERSION=1.2"});
    EXPECT_EQ(sql_value(path("out.gpkg"), "PRAGMA user_version"), "10200");
}

TEST_F(OptionEffect, lco) {
    trace({"-lco", "GEOMETRY_NAME=outline", "-lco", "SPATIAL_INDEX=NO"});
    EXPECT_EQ(buildings().geometry_column, "outline");
    EXPECT_EQ(contours().geometry_column, "outline");
    EXPECT_EQ(sql_value(path("out.gpkg"), "SELECT count(*) FROM sqlite_master WHERE name LIKE 'rtree%'"),
              "0");
}

/// Rounds a part of 0.25 by 0.5 m on a block of 10 m to whole metres, which leaves nothing of it, and to
/// tenths.
TEST_F(OptionEffect, lco__thatRoundsCoordinates) {
    RasterSpec spec = blocks();
    spec.transform = std::array<double, 6>{391000.1, 0.25, 0, 5820000.1, 0, -0.25};
    spec.values.assign(600, 0.0);
    const auto raise = [&](int row, int last_row, int col, int last_col, double z) {
        for (int r = row; r <= last_row; ++r)
            for (int c = col; c <= last_col; ++c)
                spec.values[static_cast<std::size_t>(r * spec.cols + c)] = z;
    };
    raise(3, 16, 3, 22, 10);
    raise(8, 8, 9, 10, 20);
    write(path("fine.tif"), spec);
    const auto run_with = [&](const std::string& precision) {
        return run({"-q", "-overwrite", "-preset", "thesis", "-trace", "cells", "-fl", "5", "15", "-nf", "0",
                    "-layers", "contours", "-lco", "COORDINATE_PRECISION=" + precision, "--", "fine.tif",
                    "out.geojson"});
    };
    const ToolResult refused = run_with("0");
    EXPECT_EQ(refused.status, 2);
    EXPECT_EQ(refused.err,
              "ERROR: -lco COORDINATE_PRECISION=0 rounds coordinates so much that a polygon is lost or runs "
              "into another: contour 3; the coarsest precision that keeps all is 1 decimal.\n");
    EXPECT_FALSE(std::filesystem::exists(path("out.geojson")));
    const ToolResult kept = run_with("1");
    EXPECT_EQ(kept.status, 0) << kept.err;
    const Layer stack = layer("out.geojson", "out");
    ASSERT_EQ(stack.records.size(), 3U);
    for (const Record& record : stack.records)
        EXPECT_TRUE(OGR_G_IsValid(record.geometry()));
    // The north-west corner of the part lies 2.25 m to the east and 2 m to the south of that of the raster.
    EXPECT_NE(stack.records[2].wkt().find("391002.4 5819998.1"), std::string::npos) << stack.records[2].wkt();
    for (const char* file : {"out.geojsonl", "lonlat.geojson"}) {
        Arguments converted{"-q", "-overwrite", "-lco", "COORDINATE_PRECISION=4", "fine.tif", file};
        if (std::string(file).ends_with(".geojson"))
            converted.insert(converted.begin(), {"-lco", "RFC7946=YES"});
        const ToolResult late = run(converted);
        EXPECT_EQ(late.status, 2);
        EXPECT_NE(late.err.find("-lco COORDINATE_PRECISION=4 would round coordinates after GeoJSON"),
                  std::string::npos)
            << late.err;
        EXPECT_TRUE(late.err.ends_with("; give -t_srs EPSG:4326 as well.\n")) << late.err;
        EXPECT_FALSE(std::filesystem::exists(path(file)));
    }
    // Whole metres keep shapes that lie on whole metres.
    run_well({"-q", "-fl", "5", "-layers", "contours", "-lco", "COORDINATE_PRECISION=0", "blocks.tif",
              "whole.geojson"});
    run_well({"-q", "-fl", "5", "-layers", "contours", "blocks.tif", "exact.geojson"});
    EXPECT_EQ(layer("whole.geojson", "whole").records.size(), layer("exact.geojson", "exact").records.size());
}

TEST_F(OptionEffect, nln) {
    trace({"-nln", "houses"});
    EXPECT_EQ(layer_names(path("out.gpkg")), (Names{"houses", "houses_contours"}));
    run_well({"-nln", "stack", "-layers", "contours", "-q", "-fl", "5", "--", "blocks.tif", "c.gpkg"});
    EXPECT_EQ(layer_names(path("c.gpkg")), Names{"stack"});
}

TEST_F(OptionEffect, overwrite) {
    trace({"-nf", "0"});
    add_notes(path("out.gpkg"));
    EXPECT_EQ(buildings().records.size(), 3U);
    trace({"-nf", "11", "-overwrite"});
    EXPECT_EQ(buildings().records.size(), 1U);
    EXPECT_EQ(contours().records.size(), 3U);
    EXPECT_EQ(layer("out.gpkg", "notes").records.size(), 1U);
}

TEST_F(OptionEffect, append) {
    trace({});
    add_notes(path("out.gpkg"));
    trace({"-append"});
    const Layer twice = contours();
    ASSERT_EQ(twice.records.size(), 8U);
    for (int id = 1; id <= 8; ++id)
        (void)twice.where("id", id);  // they go on
    EXPECT_EQ(twice.where("id", 6).number("parent_id"), twice.where("id", 5).number("id"));
    EXPECT_EQ(layer("out.gpkg", "notes").records.size(), 1U);
}

TEST_F(OptionEffect, append__numbersWhateverTheFieldIsCalled) {
    for (const auto& [fields, id] : {std::pair("urock", "ID_BUILD"), std::pair("city4cfd", "unique_id")}) {
        const std::string file = std::string(fields) + ".gpkg";
        for (const char* mode : {"-overwrite", "-append"})
            run_well({"-q", "-fl", "5", "-fields", fields, "-layers", "buildings", mode, "blocks.tif", file});
        EXPECT_EQ(
            sql_value(path(file), std::string("SELECT COUNT(*) - COUNT(DISTINCT ") + id + ") FROM buildings"),
            "0");
        EXPECT_EQ(sql_value(path(file), std::string("SELECT MIN(") + id + ") FROM buildings"), "1");
    }
}

TEST_F(OptionEffect, p) {
    const ToolSetup dated{.environment = {"OGR_CURRENT_DATE=2001-02-03T04:05:06Z"}};
    run_well({"-q", "-fl", "5", "--", "blocks.tif", "without.gpkg"}, dated);
    run_well({"-q", "-fl", "5", "-p", "blocks.tif", "with.gpkg"}, dated);
    EXPECT_EQ(read_bytes(path("with.gpkg")), read_bytes(path("without.gpkg")));
}

class PageErrors : public TownErrors {};

TEST_F(PageErrors, names) {
    refused(2, "Pages are written as HTML; give \"a.htm\" a name that ends in .html.", {"-page", "a.htm"});
    refused(1, "no file can be created in \"no/such\" (", {"-page", "no/such/a.html"});
    std::ofstream(path("other.html")) << "<!DOCTYPE html>\n<p>Dear diary\n";
    refused(2, "\"other.html\" exists; give another name, or -overwrite to replace it.",
            {"-page", "other.html"});
    refused(2, "\"other.html\" exists and is not a page of dem2buildings; remove it first.",
            {"-overwrite", "-page", "other.html"});
    std::filesystem::create_directory(path("folder.html"));
    refused(2, "is a folder, and a page is written as a file", {"-page", "folder.html"});
    refused(2, "'/vsimem/a.html' is in memory and lost when the program ends; give a file.",
            {"-page", "/vsimem/a.html"});
}

#ifdef D2B_PAGE

namespace {

std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_F(OptionEffect, page) {
    find({"-page", "town.html"});
    const std::string page = text_of(path("town.html"));
    EXPECT_TRUE(page.starts_with("<!DOCTYPE html>\n<!-- A page of dem2buildings -->\n"));
    EXPECT_NE(page.find("<title>town</title>"), std::string::npos);
    EXPECT_TRUE(page.ends_with("</html>\n"));
    // The same on any number of threads.
    for (const char* threads : {"1", "4"}) {
        find({"-page", "town.html", "-threads", threads});
        EXPECT_EQ(text_of(path("town.html")), page);
    }
    // Layers are the same without it, and whatever of them is written the page has the stack.
    find({"-page", "blocks.html", "-layers", "buildings"});
    EXPECT_GT(text_of(path("blocks.html")).size(), page.size() - 1000);
    trace({"-overwrite", "-page", "thesis.html"});
    EXPECT_NE(text_of(path("thesis.html")).find("<title>"), std::string::npos);
}

TEST_F(PageErrors, coordinates) {
    refused(2,
            "-page needs coordinates in a unit of length, and those of 'WGS 84' are angles; convert them to "
            "a projected CRS with -t_srs, such as the UTM zone of the area.",
            {"-page", "a.html", "-t_srs", "EPSG:4326"});
}

TEST_F(PageErrors, replacesItsOwn) {
    find({"-page", "a.html"});
    run_well({"-preset", "buildings", "-q", "-overwrite", "-page", "a.html", "--", "town.tif", "o.gpkg"});
    EXPECT_FALSE(text_of(path("a.html")).empty());
}

#else

TEST_F(OptionEffect, page) {
    write(path("town.tif"), town_raster(MadeTown::surface()));
    expect_error(2,
                 "This dem2buildings was built without pages; leave -page out, or build it with -D "
                 "D2B_BUILD_PAGE=ON.",
                 {"-q", "-page", "a.html", "town.tif", "o.gpkg"});
}

#endif

namespace {

/// 12 x 12 cells of a metre; two blocks of 4 x 4 of them, 20 m high, touch in a corner, which is at
/// (391006, 5819994).
RasterSpec touching_blocks() {
    RasterSpec spec = town_raster(std::vector<double>(144, 0));
    spec.rows = spec.cols = 12;
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t col = 0; col < 4; ++col) {
            spec.values[(2 + row) * 12 + 2 + col] = 20;
            spec.values[(6 + row) * 12 + 6 + col] = 20;
        }
    return spec;
}

/// Twelve blocks of 4 x 4 cells, 20 m high, stand where nothing else is known, below each other, and one
/// beside them on ground.
RasterSpec blocks_without_ground() {
    constexpr std::size_t rows = 74;
    constexpr std::size_t cols = 16;
    RasterSpec spec = town_raster(std::vector<double>(rows * cols, -9999));
    spec.rows = rows;
    spec.cols = cols;
    spec.nodata = -9999;
    const auto put = [&](std::size_t top, std::size_t left, std::size_t height, std::size_t width, double z) {
        for (std::size_t row = top; row < top + height; ++row)
            for (std::size_t col = left; col < left + width; ++col)
                spec.values[row * cols + col] = z;
    };
    // Not level, because one value along the border is undeclared NoData.
    for (std::size_t row = 0; row < rows; ++row)
        put(row, 8, 1, 8, row % 2 == 0 ? -0.5 : -0.25);
    put(2, 10, 4, 4, 20);
    for (std::size_t i = 0; i < 12; ++i)
        put(2 + 6 * i, 2, 4, 4, 20);
    return spec;
}

const Arguments thesis{"-preset", "thesis", "-trace", "cells",    "-fl",   "0",          "10",
                       "-nf",     "0",      "-q",     "-surface", "s.obj", "-overwrite", "-write_problems"};

Arguments thesis_with(const Arguments& more) {
    Arguments all = thesis;
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

}  // namespace

TEST_F(OptionEffect, write_problems) {
    write(path("touch.tif"), touching_blocks());
    const std::string report = run_well(thesis_with({"-json", "--", "touch.tif", "out.gpkg"}));
    EXPECT_EQ(nlohmann::json::parse(report)["dropped"]["surface_corner_cut"], 1);
    EXPECT_EQ(layer_names(path("out.gpkg")), (std::vector<std::string>{"buildings", "contours", "problems"}));
    const Layer problems = layer("out.gpkg", "problems");
    EXPECT_EQ(problems.type, wkbPoint);
    ASSERT_EQ(problems.records.size(), 1U);
    const Record& problem = problems.records.front();
    EXPECT_EQ(problem.wkt(), "POINT (391006 5819994)");
    EXPECT_EQ(problem.number("id"), 1);
    EXPECT_EQ(problem.text("kind"), "surface_corner_cut");
    EXPECT_EQ(problem.number("building"), 1);
    EXPECT_EQ(problem.number("other"), 2);
    EXPECT_EQ(problem.number("before"), 0);
    // A centimetre is 10.24 steps of 1/1024 m, so 11 of them along the diagonal, where most room is.
    EXPECT_NEAR(problem.number("after"), 11 * std::sqrt(2) / 1024, 1e-9);
    EXPECT_EQ(problem.text("state"), "changed");
    run_well(thesis_with({"-nln", "roofs", "--", "touch.tif", "out.gpkg"}));
    EXPECT_EQ(layer("out.gpkg", "roofs_problems").records.size(), 1U);
}

/// Buildings without a surface are named, up to ten, counted, and have their places; the rest is made.
TEST_F(OptionEffect, write_problems__ofBuildingsThatAreLost) {
    write(path("bare.tif"), blocks_without_ground());
    Arguments arguments = thesis_with({"-surface_of", "buildings", "-json", "--", "bare.tif", "out.gpkg"});
    const ToolResult result = run(arguments);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(nlohmann::json::parse(result.out)["dropped"]["surface_lost"], 12) << result.out;
    expect_has(result.err,
               " is not in the surface: it has no height above its ground, or no closed surface was found "
               "for it.\n");
    expect_has(result.err, "Warning: 2 more buildings are not in the surface.\n");
    EXPECT_EQ(read_obj(path("s.obj")).objects().size(), 1U);
    const Layer lost = layer("out.gpkg", "problems");
    ASSERT_EQ(lost.records.size(), 12U);
    for (const Record& problem : lost.records) {
        EXPECT_EQ(problem.text("kind"), "surface_lost");
        EXPECT_EQ(problem.text("state"), "left");
        EXPECT_NEAR(problem.number("before"), 16, 0.01);
        EXPECT_LE(OGR_G_GetX(problem.geometry(), 0), 391006);
    }
}

TEST_F(OptionEffect, write_problems__whereAFormatHoldsOneLayer) {
    write(path("touch.tif"), touching_blocks());
    Arguments arguments = thesis_with({"-layers", "buildings", "--", "touch.tif", "out.geojson"});
    std::erase(arguments, "-q");
    run_warned(arguments, {"Warning: -write_problems: the format holds one layer, which has no room for 1 "
                           "problem; write a GeoPackage."});
    EXPECT_EQ(layer("out.geojson", "out").records.size(), 2U);
}

TEST_F(OptionEffect, write_problems__addsToTheLayer) {
    write(path("touch.tif"), touching_blocks());
    Arguments arguments = thesis_with({"--", "touch.tif", "out.gpkg"});
    run_well(arguments);
    std::ranges::replace(arguments, std::string("-overwrite"), std::string("-append"));
    arguments.insert(arguments.begin(), {"-surface_origin", "391000", "5820000", "0"});
    std::filesystem::remove(path("s.obj"));
    std::filesystem::remove(path("s.mtl"));
    run_well(arguments);
    const Layer problems = layer("out.gpkg", "problems");
    ASSERT_EQ(problems.records.size(), 2U);
    EXPECT_GT(problems.records[1].number("id"), problems.records[0].number("id"));
}

}  // namespace d2b::test

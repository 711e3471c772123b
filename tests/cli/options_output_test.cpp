#include <cmath>

#include "cli/option_effect.hpp"

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
    // Whole metres keep what lies on whole metres.
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

}  // namespace d2b::test

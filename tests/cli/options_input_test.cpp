#include <algorithm>

#include "cli/option_effect.hpp"

namespace d2b::test {

void OptionEffect::SetUp() {
    CliTest::SetUp();
    write(path("blocks.tif"), blocks());
}

std::string OptionEffect::trace(Arguments arguments) const {
    const auto given = [&](const char* option) { return std::ranges::count(arguments, option) > 0; };
    if (!given("-fl") && !given("-lod") && !given("-i"))
        arguments.insert(arguments.begin(), {"-fl", "5", "15"});
    arguments.insert(arguments.end(), {"blocks.tif", "out.gpkg"});
    return run_well(arguments);
}

namespace {

/// Two bands: in the first all is flat but for one building.
RasterSpec one_building() {
    RasterSpec spec = blocks();
    for (double& z : spec.values)
        if (z == 10 || z == 20 || z == 8)
            z = 0;
    return spec;
}

TEST_F(OptionEffect, b) {
    RasterSpec spec = one_building();
    spec.bands = 2;
    const GDALDatasetH dataset = create(path("two.tif"), spec);
    std::vector<double> second = blocks().values;
    ASSERT_EQ(GDALRasterIO(GDALGetRasterBand(dataset, 2), GF_Write, 0, 0, 30, 20, second.data(), 30, 20,
                           GDT_Float64, 0, 0),
              CE_None);
    GDALClose(dataset);
    run_well({"-q", "-fl", "5", "two.tif", "first.gpkg"});
    run_well({"-q", "-fl", "5", "-b", "2", "two.tif", "second.gpkg"});
    EXPECT_EQ(layer("first.gpkg", "buildings").records.size(), 1U);
    EXPECT_EQ(layer("second.gpkg", "buildings").records.size(), 2U);
}

TEST_F(OptionEffect, oo) {
    trace({});
    EXPECT_NEAR(contours().records[0].box().MinX, 391000.5, 1e-9);
    run_warned({"-q", "-fl", "5", "15", "-oo", "GEOREF_SOURCES=NONE", "blocks.tif", "plain.gpkg"},
               {"no georeferencing", "no coordinate reference system"});
    EXPECT_NEAR(layer("plain.gpkg", "contours").records[0].box().MinX, 0.5, 1e-9);
}

/// A grid in text and an empty GeoTIFF's driver: only the named format is tried.
TEST_F(OptionEffect, if) {
    trace({"-if", "GTiff"});
    EXPECT_EQ(buildings().records.size(), 2U);
    expect_error(1, "not recognized as", {"-if", "AAIGrid", "blocks.tif", "other.gpkg"});
    trace({"-if", "AAIGrid", "-if", "GTiff", "-overwrite"});  // any of them
}

TEST_F(OptionEffect, a_srs) {
    RasterSpec spec = blocks();
    spec.transform = std::array<double, 6>{1500000, 1, 0, 550000, 0, -1};
    write(path("moved.tif"), spec);
    const Arguments given{"-q", "-a_srs", "EPSG:2264", "-fl", "5", "--", "moved.tif", "out.gpkg"};
    run_well(given);
    EXPECT_EQ(buildings().crs, "NAD83 / North Carolina (ftUS)");
    EXPECT_EQ(buildings().records[0].box().MinX, 1500003.5);  // nothing is reprojected
    // 63 square feet; the scale of this projection differs from 1 by some 1e-4 at most.
    EXPECT_NEAR(buildings().records[0].number("area_m2"), 63 * 0.3048 * 0.3048, 0.003);
}

TEST_F(OptionEffect, a_srs__compound) {
    trace({"-a_srs", "EPSG:25833+6360"});  // heights in US survey feet
    EXPECT_NEAR(buildings().where("id", 1).number("height"), 20 * 1200.0 / 3937, 0.005);
}

TEST_F(OptionEffect, snodata) {
    trace({});
    EXPECT_EQ(contours().sum("n_points", 0), 600);
    trace({"-snodata", "10", "-overwrite"});
    EXPECT_EQ(contours().sum("n_points", 0), 600 - 60);
    EXPECT_EQ(contours().where("level", 2).number("n_points"), 20);
}

TEST_F(OptionEffect, inodata) {
    RasterSpec spec = blocks();
    spec.nodata = 10;
    write(path("holes.tif"), spec);
    run_well({"-q", "-fl", "5", "holes.tif", "without.gpkg"});
    run_well({"-q", "-fl", "5", "-inodata", "holes.tif", "with.gpkg"});
    EXPECT_EQ(layer("without.gpkg", "contours").sum("n_points", 0), 600 - 60);
    EXPECT_EQ(layer("with.gpkg", "contours").sum("n_points", 0), 600);
}

TEST_F(OptionEffect, zrange) {
    run_warned({"-q", "-fl", "5", "15", "-zrange", "-0.5", "15", "--", "blocks.tif", "out.gpkg"},
               {"20 cells of 'blocks.tif' have the elevation 20, which is outside of -zrange -0.5 15, and "
                "are treated as no data; if 20 stands for no data, give -snodata 20, and if not, the range "
                "with -zrange."});
    EXPECT_EQ(contours().sum("n_points", 0), 600 - 20);
}

TEST_F(OptionEffect, zunit) {
    trace({"-zunit", "m"});
    EXPECT_DOUBLE_EQ(buildings().where("id", 1).number("height"), 20);
    trace({"-zunit", "ft", "-overwrite"});
    EXPECT_EQ(buildings().where("id", 1).number("height"), 6.1);      // 20 * 0.3048, in hundredths
    EXPECT_DOUBLE_EQ(buildings().where("id", 1).number("roof"), 20);  // stays in the unit of the DEM
    trace({"-zunit", "us-ft", "-overwrite"});
    EXPECT_EQ(buildings().where("id", 1).number("height"), 6.1);  // 20 * 1200 / 3937, likewise
    trace({"-zunit", "0.5", "-overwrite"});
    EXPECT_DOUBLE_EQ(buildings().where("id", 1).number("height"), 10);
}

}  // namespace

TEST_F(OptionEffect, srcwin) {
    trace({"-srcwin", "15", "0", "15", "20"});
    const Layer stack = contours();
    EXPECT_EQ(stack.records[0].number("n_points"), 15 * 20);
    EXPECT_EQ(stack.records[0].box().MinX, 391015.5);
    EXPECT_EQ(stack.records[0].box().MaxX, 391029.5);
    ASSERT_EQ(buildings().records.size(), 1U);
    EXPECT_EQ(buildings().records[0].number("height"), 6);
    EXPECT_EQ(buildings().records[0].area(), 6);
}

TEST_F(OptionEffect, projwin) {
    trace({"-projwin", "391003", "5819997", "391010", "5819990"});
    // The points with 391003 <= x < 391010 and so in y: columns 3 to 9, rows 3 to 9.
    const Layer stack = contours();
    EXPECT_EQ(stack.records[0].number("n_points"), 7 * 7);
    EXPECT_EQ(stack.records[0].box().MinX, 391003.5);
    EXPECT_EQ(stack.records[0].box().MaxY, 5819996.5);
    EXPECT_EQ(stack.records[0].number("elev_min"), 10);
}

TEST_F(OptionEffect, te) {
    trace({"-te", "391015", "5819990", "391030", "5820000"});
    const Layer stack = contours();
    EXPECT_EQ(stack.records[0].number("n_points"), 15 * 10);
    EXPECT_EQ(stack.records[0].box().MinX, 391015.5);
    EXPECT_EQ(stack.records[0].box().MinY, 5819990.5);
    ASSERT_EQ(buildings().records.size(), 1U);
    EXPECT_EQ(buildings().records[0].number("height"), 6);
}

TEST_F(OptionEffect, cutline) {
    write_text(path("area.geojson"),
               R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:25833"}},
                   "features": [{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates":
                   [[[391015, 5820000], [391030, 5820000], [391030, 5819980], [391015, 5820000]]]}}]})");
    trace({"-cutline", "area.geojson", "-trace", "cells"});
    // Those cells count whose centres are in the triangle: to the right of x = 15 + 0.75 y, y downwards.
    int inside = 0;
    for (int row = 0; row < 20; ++row)
        for (int col = 15; col < 30; ++col)
            inside += col + 0.5 > 15 + 0.75 * (row + 0.5) ? 1 : 0;
    EXPECT_EQ(contours().sum("n_points", 0), inside);
    ASSERT_EQ(buildings().records.size(), 1U);
    EXPECT_EQ(buildings().records[0].area(), 3 + 2 + 1);  // the areas inside of rows 5, 6 and 7
}

/// Two rectangles of cells, one a layer of areas.vrt: rows 5 to 7 of a building, and the area to the left of
/// it.
TEST_F(OptionEffect, cutline_layer) {
    const auto file = [this](const std::string& name, int left, int right) {
        const auto x = [](int col) { return std::to_string(391000 + col); };
        write_text(path(name + ".csv"), "id,WKT\n1,\"POLYGON ((" + x(left) + " 5820000," + x(right) +
                                            " 5820000," + x(right) + " 5819980," + x(left) + " 5819980," +
                                            x(left) + " 5820000))\"\n");
        return "<OGRVRTLayer name=\"" + name + "\"><SrcDataSource relativeToVRT=\"1\">" + name +
               ".csv</SrcDataSource><SrcLayer>" + name +
               "</SrcLayer><LayerSRS>EPSG:25833</LayerSRS>"
               "</OGRVRTLayer>";
    };
    write_text(path("areas.vrt"),
               "<OGRVRTDataSource>" + file("west", 0, 15) + file("east", 15, 30) + "</OGRVRTDataSource>");
    trace({"-cutline", "areas.vrt", "-cutline_layer", "east", "-trace", "cells"});
    EXPECT_EQ(contours().sum("n_points", 0), 15 * 20);
    ASSERT_EQ(buildings().records.size(), 1U);
    EXPECT_EQ(buildings().records[0].area(), 3 * 4);
    run_warned({"-q", "-overwrite", "-fl", "5", "-cutline", "areas.vrt", "blocks.tif", "out.gpkg"},
               {"has the layers 'west' and 'east'; 'west' is taken, and -cutline_layer takes another."});
    EXPECT_EQ(buildings().records.size(), 1U);
}

}  // namespace d2b::test

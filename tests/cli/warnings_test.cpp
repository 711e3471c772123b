#include "cli/cli_test_case.hpp"

namespace d2b::test {
namespace {

const std::vector<std::string> building_fields{
    "id",      "ground", "roof",       "height",    "min_height", "p50",      "p70",
    "p90",     "p95",    "num_floors", "has_parts", "n_parts",    "n_levels", "n_points",
    "n_cells", "nodata", "confidence", "doubt",     "at_edge",    "area_m2",  "volume_m3",
    "perim_m", "status", "moved_m",    "area_chg"};
const std::vector<std::string> contour_fields{
    "id",        "parent_id", "bldg_id",    "level",   "threshold", "base",
    "top",       "height",    "min_height", "tier_z",  "n_points",  "elev_min",
    "elev_mean", "elev_max",  "confidence", "area_m2", "perim_m",   "status"};

/// Results without a building are whole all the same.
class Warnings : public CliTest {
  protected:
    void expect_layers(std::size_t buildings, std::size_t contours) const {
        EXPECT_EQ(layer_names(path("out.gpkg")), (std::vector<std::string>{"buildings", "contours"}));
        const Layer footprints = layer("out.gpkg", "buildings");
        const Layer stack = layer("out.gpkg", "contours");
        EXPECT_EQ(footprints.fields, building_fields);
        EXPECT_EQ(stack.fields, contour_fields);
        EXPECT_EQ(footprints.type, wkbMultiPolygon);
        EXPECT_EQ(footprints.records.size(), buildings);
        EXPECT_EQ(stack.records.size(), contours);
    }
    void warned(const RasterSpec& spec, const std::vector<std::string>& parts,
                Arguments arguments = {}) const {
        write(path("dem.tif"), spec);
        arguments.insert(arguments.end(), {"-q", "--", "dem.tif", "out.gpkg"});
        EXPECT_EQ(run_warned(arguments, parts), "");
    }
};

TEST_F(Warnings, noValidPoint) {
    RasterSpec spec = blocks();
    spec.values.assign(600, -9999);
    spec.nodata = -9999;
    warned(spec, {"'dem.tif' has no valid point; the layers are empty."});
    expect_layers(0, 0);
}

TEST_F(Warnings, flatData) {
    RasterSpec spec = blocks();
    spec.values.assign(600, 12.5);
    warned(spec, {"All valid points of 'dem.tif' have the same elevation; no building was found."});
    expect_layers(0, 1);
    EXPECT_EQ(layer("out.gpkg", "contours").records[0].number("elev_max"), 12.5);
}

TEST_F(Warnings, oneRow) {
    RasterSpec spec = blocks();
    spec.rows = 1;
    spec.values.assign(30, 0);
    spec.values[10] = spec.values[11] = spec.values[12] = 9;
    warned(spec, {"No building was found; a smaller -nf or -min_area, or more levels, may show some."});
    expect_layers(0, 0);  // points without area have no outline
}

TEST_F(Warnings, oneColumnInCells) {
    RasterSpec spec = blocks();
    spec.cols = 1;
    spec.rows = 30;
    spec.values.assign(30, 0);
    spec.values[10] = spec.values[11] = spec.values[12] = 9;
    write(path("dem.tif"), spec);
    run_well({"-q", "-trace", "cells", "-nf", "0", "-fl", "5", "--", "dem.tif", "out.gpkg"});
    expect_layers(1, 2);
    EXPECT_EQ(layer("out.gpkg", "buildings").records[0].area(), 3);
}

TEST_F(Warnings, onePoint) {
    RasterSpec spec = blocks();
    spec.rows = spec.cols = 1;
    spec.values = {7};
    warned(spec, {"All valid points of 'dem.tif' have the same elevation"});
    expect_layers(0, 0);
}

TEST_F(Warnings, nothingFound) {
    warned(blocks(), {"No building was found; a smaller -nf or -min_area, or more levels, may show some."},
           {"-nf", "1000", "-fl", "5"});
    expect_layers(0, 1);
}

TEST_F(Warnings, noThresholdInside) {
    warned(blocks(),
           {"No threshold lies between the lowest and the highest elevation; no building was found."},
           {"-fl", "-5", "50"});
    expect_layers(0, 1);
}

TEST_F(Warnings, noCrs) {
    RasterSpec spec = blocks();
    spec.crs = "";
    warned(spec,
           {"'dem.tif' has no coordinate reference system; lengths are taken as plain units; give it with "
            "-a_srs."},
           {"-fl", "5"});
    expect_layers(2, 3);
    EXPECT_EQ(layer("out.gpkg", "buildings").records[0].number("area_m2"), 63);
}

TEST_F(Warnings, noGeotransform) {
    RasterSpec spec = blocks();
    spec.transform.reset();
    spec.crs = "";
    warned(spec,
           {"'dem.tif' has no georeferencing; coordinates are columns and, upwards, rows.",
            "'dem.tif' has no coordinate reference system"},
           {"-fl", "5"});
    const OGREnvelope box = layer("out.gpkg", "buildings").records[0].box();
    EXPECT_EQ(box.MinX, 3.5);  // the centre of column 3
    EXPECT_EQ(box.MaxY, -3.5);
    EXPECT_EQ(box.MinY, -10.5);
}

TEST_F(Warnings, coarseCells) {
    RasterSpec spec = blocks();
    spec.transform = std::array<double, 6>{391000, 5, 0, 5820000, 0, -5};
    warned(spec,
           {"The cells are 5.0 m wide, which is too coarse for single buildings; up to 1 m is best, 2.5 m "
            "may do."},
           {"-fl", "5"});
    expect_layers(2, 3);
}

TEST_F(Warnings, coarseCellsInDegrees) {
    RasterSpec spec = blocks();
    spec.transform = std::array<double, 6>{13, 0.0001, 0, 52, 0, -0.0001};
    spec.crs = "EPSG:4326";
    // sqrt(11.13 m x cos(52 degrees) x 11.13 m) = 8.7 m
    warned(spec, {"The cells are 8.7 m wide"}, {"-fl", "5", "-inodata"});
}

TEST_F(Warnings, oneLayer) {
    write(path("dem.tif"), blocks());
    run_warned(
        {"-q", "-fl", "5", "--", "dem.tif", "out.geojson"},
        {R"("out.geojson" holds one layer; only the buildings are written; use -layers contours for the stack)"});
    EXPECT_EQ(layer("out.geojson", "out").records.size(), 2U);
}

TEST_F(Warnings, cutlineElsewhere) {
    write_text(path("area.geojson"),
               R"({"type": "Polygon", "coordinates": [[[1, 1], [2, 1], [2, 2], [1, 1]]]})");
    warned(blocks(),
           {"The cutline 'area.geojson' does not meet the part of 'dem.tif' that is used",
            "'dem.tif' has no valid point"},
           {"-cutline", "area.geojson"});
    expect_layers(0, 0);
}

TEST_F(Warnings, colourTable) {
    RasterSpec spec = blocks();
    spec.type = GDT_Byte;
    const GDALDatasetH dataset = create(path("dem.tif"), spec);
    GDALColorTableH colours = GDALCreateColorTable(GPI_RGB);
    const GDALColorEntry black{0, 0, 0, 255};
    GDALSetColorEntry(colours, 0, &black);
    ASSERT_EQ(GDALSetRasterColorTable(GDALGetRasterBand(dataset, 1), colours), CE_None);
    GDALDestroyColorTable(colours);
    GDALClose(dataset);
    run_warned({"-q", "-fl", "5", "--", "dem.tif", "out.gpkg"},
               {"Band 1 of 'dem.tif' holds indices into a colour table; they are taken as elevations."});
    expect_layers(2, 3);
}

}  // namespace
}  // namespace d2b::test

#include <cpl_string.h>
#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"
#include "read/side_fixture.hpp"

namespace d2b::reading {
namespace {

using namespace test;

class SideRefusal : public SideTest {
  protected:
    void SetUp() override {
        SideTest::SetUp();
        dem({.cols = 4, .rows = 4, .transform = {{500000, 1, 0, 5538650, 0, -1}}});
    }
    std::string refusal() {
        return refused<InputError>([this] { terrain(); });
    }
    void one_cell(double x, double y, const std::string& crs = "EPSG:25832") {
        write(path("side.tif"), {.values = {100}, .transform = {{x, 1, 0, y, 0, -1}}, .crs = crs});
    }
};

TEST_F(SideRefusal, noSuchFile) {
    EXPECT_EQ(refusal(), quoted("side.tif") + " cannot be opened as a raster: No such file or directory.");
    EXPECT_EQ(refused<InputError>([this] { mask(); }),
              "The mask " + quoted("side.tif") +
                  " cannot be opened as a raster or as polygons: No such file or directory.");
    EXPECT_EQ(refused<InputError>([this] { ndvi(); }),
              quoted("side.tif") + " cannot be opened as a raster: No such file or directory.");
}

TEST_F(SideRefusal, complexNumbers) {
    write(path("side.tif"), {.type = GDT_CFloat32, .values = {1}});
    EXPECT_EQ(refusal(),
              "Band 1 of " + quoted("side.tif") + " holds complex numbers; give a raster of real numbers.");
}

TEST_F(SideRefusal, anotherPlace) {
    const std::string start = "The terrain " + quoted("side.tif") + " has no cell in the part of " +
                              quoted("dem.tif") + " that is used";
    one_cell(600000, 5538650);
    EXPECT_EQ(refusal(),
              start + "; give one of the same area, or correct a coordinate reference system that is wrong.");
    one_cell(500000, 5538650, "EPSG:25833");
    EXPECT_EQ(refusal(),
              start + "; give one of the same area, or correct a coordinate reference system that is wrong.");
    one_cell(9, 50, "");
    EXPECT_EQ(refusal(), start +
                             " in the coordinates of the latter, and it has no coordinate reference system; "
                             "give it its own with gdal_edit.py -a_srs.");
    dem({.transform = {{9, 1e-5, 0, 50, 0, -1e-5}}, .crs = ""});
    one_cell(500000, 5538650);
    EXPECT_EQ(refusal(), start +
                             " in the coordinates of the former, and the DEM has no coordinate reference "
                             "system; give it with -a_srs.");
}

TEST_F(SideRefusal, onlyTheWindowCounts) {
    options_.source_window = {0, 0, 2, 4};
    dem({.cols = 4, .rows = 4, .transform = {{500000, 1, 0, 5538650, 0, -1}}});
    one_cell(500003, 5538650);
    expect_has(refusal(), "has no cell in the part of");
}

TEST_F(SideRefusal, aSpeckOfARasterIsFound) {
    dem({.cols = 5000, .rows = 5000, .type = GDT_Byte, .transform = {{500000, 1, 0, 5538650, 0, -1}}});
    one_cell(500012, 5538650 - 4321);
    const auto source = open_terrain(path("side.tif"), grid_, 1, land_elevations, callbacks_);
    std::vector<double> row(5000);
    source->read(whole_rows(*source, 4321, 1), row);
    EXPECT_EQ(row[12], 100);
    EXPECT_EQ(warnings().at(0), "More than 99 % of " + quoted("dem.tif") + " lies outside of the terrain " +
                                    quoted("side.tif") + "; there is no ground there.");
}

TEST_F(SideRefusal, aMissingCrsIsAnAssumption) {
    one_cell(500000, 5538650, "");
    EXPECT_EQ(terrain().at(0), 100);
    ASSERT_EQ(warnings().size(), 2U);
    EXPECT_EQ(warnings()[0],
              "The terrain " + quoted("side.tif") +
                  " has no coordinate reference system; its coordinates are taken as those of " +
                  quoted("dem.tif") + ".");
    dem({.transform = {{500000, 1, 0, 5538650, 0, -1}}, .crs = ""});
    one_cell(500000, 5538650);
    EXPECT_EQ(terrain().at(0), 100);
    ASSERT_EQ(warnings().size(), 1U);
    EXPECT_EQ(warnings()[0], "The terrain " + quoted("side.tif") + " has a coordinate reference system and " +
                                 quoted("dem.tif") + " has none; coordinates of both are taken as the same.");
    warnings_.clear();
    one_cell(500000, 5538650, "");
    EXPECT_EQ(terrain().at(0), 100);
    EXPECT_TRUE(warnings().empty());
}

TEST_F(SideRefusal, georeferencesThatAreMissing) {
    write(path("side.tif"), {.values = {100}, .transform = {}});
    EXPECT_EQ(refusal(), "The terrain " + quoted("side.tif") + " has no georeference and " +
                             quoted("dem.tif") +
                             " has one; give both of them one, for example with gdal_edit.py -a_ullr.");
    dem({.cols = 2, .transform = {}, .crs = ""});
    one_cell(0, 0);
    EXPECT_EQ(refusal(), "The terrain " + quoted("side.tif") + " has a georeference and " +
                             quoted("dem.tif") +
                             " has none; give both of them one, for example with gdal_edit.py -a_ullr.");
    write(path("side.tif"), {.cols = 2, .values = {3, 4}, .transform = {}, .crs = ""});
    expect_values(terrain(), {3, 4});
    EXPECT_TRUE(warnings().empty());
}

TEST_F(SideRefusal, transformsOfNoUse) {
    write(path("side.tif"), {.values = {100}, .transform = {{0, 1, 1, 0, 1, 1}}});
    EXPECT_EQ(refusal(), "The transform of " + quoted("side.tif") +
                             " (0, 1, 1, 0, 1, 1) gives its cells no area; correct it, for example with "
                             "gdal_edit.py -a_ullr.");
    const GDALDatasetH dataset = create(path("side.tif"), {.values = {100}, .transform = {}, .crs = ""});
    const std::array<GDAL_GCP, 1> points{
        {{const_cast<char*>("1"), const_cast<char*>(""), 0, 0, 500000, 5538650, 0}}};
    ASSERT_EQ(GDALSetGCPs(dataset, 1, points.data(), ""), CE_None);
    GDALClose(dataset);
    EXPECT_EQ(refusal(), quoted("side.tif") +
                             " is placed by ground control points only; turn it into a regular grid with "
                             "gdalwarp first.");
}

TEST_F(SideRefusal, crssWithoutAnOperation) {
    one_cell(0, 0, "LOCAL_CS[\"site\",UNIT[\"metre\",1]]");
    const std::string text = refusal();
    EXPECT_EQ(text.rfind("The terrain " + quoted("side.tif") +
                             " cannot be converted to the coordinate reference system of " +
                             quoted("dem.tif") + ": ",
                         0),
              0U)
        << text;
    expect_has(text, "; reproject it with gdalwarp first.");
}

/// A file that ends in the middle of its cells.
void truncate(const std::string& path) {
    const std::string bytes = read_bytes(path);
    write_text(path, bytes.substr(0, bytes.size() / 2));
}

TEST_F(SideRefusal, damageIsToldInBothWays) {
    for (const double cell : {1.0, 0.9}) {
        write(path("side.tif"), {.cols = 64,
                                 .rows = 64,
                                 .values = counting(64 * 64),
                                 .transform = {{500000 - 32 * cell, cell, 0, 5538650 + 56 * cell, 0, -cell}},
                                 .creation = {"COMPRESS=DEFLATE", "BLOCKYSIZE=8"}});
        truncate(path("side.tif"));
        const std::string text = refusal();
        EXPECT_EQ(text.rfind("Rows ", 0), 0U) << text;
        expect_has(text, " of " + quoted("side.tif") + " cannot be read: ");
        expect_has(text, "; the file may be truncated or damaged.");
        EXPECT_EQ(text.find("cannot be read", text.find("cannot be read") + 1), std::string::npos) << text;
    }
}

TEST_F(SideRefusal, cellsOutsideOfTheWindow) {
    options_.source_window = {1, 1, 3, 2};
    dem({.cols = 5, .rows = 4, .transform = {{500000, 1, 0, 5538650, 0, -1}}});
    std::vector<double> two(2);
    for (const double x : {500000.0, 499999.7}) {
        write(path("side.tif"),
              {.cols = 6, .rows = 6, .values = counting(36), .transform = {{x, 1, 0, 5538650, 0, -1}}});
        const auto source = open_terrain(path("side.tif"), grid_, 1, land_elevations, callbacks_);
        source->read({2, 2, 1, 2}, two);
        for (const Window& part :
             {Window{0, 1, 1, 2}, Window{3, 1, 1, 2}, Window{9, 1, 1, 2}, Window{1, 0, 1, 2},
              Window{1, 3, 1, 2}, Window{2, 1, 2, 1}, Window{1, 1, 1, 3}})
            EXPECT_EQ(refused<InputError>([&] { source->read(part, two); }),
                      std::to_string(part.rows) + " rows from " + std::to_string(part.row) + " on and " +
                          std::to_string(part.cols) + " columns from " + std::to_string(part.col) +
                          " on were asked for outside the window of " + quoted("side.tif") +
                          " or for a buffer of another size; ask for a part of the window.");
    }
}

class Mask : public SideTest {
  protected:
    void SetUp() override {
        SideTest::SetUp();
        dem({.cols = 4, .rows = 2, .transform = {{500000, 1, 0, 5538650, 0, -1}}});
    }
    /// A polygon of this ring, in a GeoJSON file with or without a CRS other than degrees.
    void polygon(const std::string& ring, const std::string& crs = "EPSG::25832") {
        write_text(
            path("side.geojson"),
            R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:)" +
                crs +
                R"("}},"features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[)" +
                ring + "]]}}]}");
    }
};

TEST_F(Mask, anyValueButZeroAndNoData) {
    write(path("side.tif"), {.cols = 4,
                             .rows = 2,
                             .type = GDT_Float32,
                             .values = {0, 1, 255, -3, 7, none, 0.5, 0},
                             .transform = {{500000, 1, 0, 5538650, 0, -1}},
                             .nodata = 7});
    expect_values(mask(), {0, 1, 1, 1, 0, 0, 1, 0});
}

TEST_F(Mask, valuesThatHardlyMarkAnythingAreNamed) {
    const auto warned = [this](const std::vector<double>& values) {
        write(path("side.tif"),
              {.cols = 4, .rows = 2, .type = GDT_Float32, .values = values, .transform = grid_.transform});
        warnings_.clear();
        (void)mask();
        return warnings().empty() ? "" : warnings().front();
    };
    EXPECT_EQ(warned({-9999, -9999, 0, 1, 0, 1, 0, 1}),
              "2 cells of the mask " + quoted("side.tif") +
                  " have the value -9999 and count as inside; if it stands for no data, declare that with "
                  "gdal_edit.py -a_nodata -9999.");
    EXPECT_EQ(warned({255, 0, 0, 1, 0, 1, 0, 1}),
              "1 cell of the mask " + quoted("side.tif") +
                  " has the value 255 and counts as inside; if it stands for no data, declare that with "
                  "gdal_edit.py -a_nodata 255.");
    EXPECT_EQ(warned({255, 0, 0, 255, 0, 255, 0, 0}), "") << "the usual mask";
    EXPECT_EQ(warned({5, 0, 11, 3, 0, 7, 0, 0}), "") << "classes";
}

TEST_F(Mask, theCellAroundTheCentre) {
    // Cells of 2 m from 499999.6 on: centres at .5, 1.5 lie in the first, 2.5 and 3.5 in the second.
    write(path("side.tif"), {.cols = 2,
                             .rows = 1,
                             .type = GDT_Byte,
                             .values = {9, 0},
                             .transform = {{499999.6, 2, 0, 5538650, 0, -1}}});
    expect_values(mask(), {1, 1, 0, 0, 0, 0, 0, 0});
    EXPECT_TRUE(warnings().empty()) << "outside of a mask is outside";
}

TEST_F(Mask, aPaletteIsNoMatter) {
    const GDALDatasetH dataset =
        create(path("side.tif"),
               {.cols = 4, .rows = 2, .type = GDT_Byte, .values = counting(8), .transform = grid_.transform});
    const GDALColorTableH colours = GDALCreateColorTable(GPI_RGB);
    const GDALColorEntry red{255, 0, 0, 255};
    GDALSetColorEntry(colours, 1, &red);
    GDALSetRasterColorTable(GDALGetRasterBand(dataset, 1), colours);
    GDALDestroyColorTable(colours);
    GDALClose(dataset);
    expect_values(mask(), {0, 1, 1, 1, 1, 1, 1, 1});
    EXPECT_TRUE(warnings().empty());
}

TEST_F(Mask, polygons) {
    polygon("[500000.4,5538650],[500002.4,5538650],[500002.6,5538648],[500000.6,5538648],[500000.4,5538650]",
            "EPSG::25832");
    // The left side passes x = 500000.45 at the centres of the first row and 500000.55 at the second's.
    expect_values(mask("side.geojson"), {1, 1, 0, 0, 0, 1, 1, 0});
    const auto source = open_mask(path("side.geojson"), "", grid_, callbacks_);
    EXPECT_EQ(source->info().name, path("side.geojson"));
    EXPECT_EQ(source->info().transform, grid_.transform);
    std::vector<double> row(4);
    source->read(whole_rows(*source, 1, 1), row);
    expect_values(row, {0, 1, 1, 0});
    EXPECT_EQ(refused<InputError>([&] { source->read(whole_rows(*source, 2, 1), row); }),
              "1 rows from 2 on and 4 columns from 0 on were asked for outside the window of " +
                  quoted("side.geojson") + " or for a buffer of another size; ask for a part of the window.");
}

TEST_F(Mask, otherPlacesAreRefused) {
    polygon("[600000,5538650],[600002,5538650],[600002,5538648],[600000,5538650]", "EPSG::25832");
    EXPECT_EQ(refused<InputError>([this] { mask("side.geojson"); }),
              "The mask " + quoted("side.geojson") + " has no polygon in the part of " + quoted("dem.tif") +
                  " that is used; give one of the same area.");
    write(path("side.tif"), {.values = {1}});
    expect_has(refused<InputError>([this] { mask(); }),
               "The mask " + quoted("side.tif") + " has no cell in the part of ");
}

TEST_F(Mask, messagesOfPolygonsSpeakOfAMask) {
    write_text(path("side.csv"), "id,WKT\n1,\"POINT (500001 5538649)\"\n");
    EXPECT_EQ(refused<InputError>([this] { mask("side.csv"); }),
              "The layer 'side' of the mask " + quoted("side.csv") +
                  " has no polygons; give one that has, for example with -mask_layer.");
    polygon("[500000,5538650],[500002,5538650],[500002,5538648],[500000,5538650]", "EPSG::25832");
    dem({.crs = ""});
    EXPECT_EQ(refused<InputError>([this] { mask("side.geojson"); }),
              "The mask " + quoted("side.geojson") + " has a coordinate reference system and " +
                  quoted("dem.tif") + " has none; give the DEM's with -a_srs.");
}

TEST_F(Mask, aRasterHasNoLayers) {
    write(path("side.tif"), {.cols = 4, .rows = 2, .values = counting(8)});
    EXPECT_EQ(refused<OptionError>([this] { mask("side.tif", "roofs"); }),
              "The mask " + quoted("side.tif") + " is a raster and has no layers; leave out -mask_layer.");
}

TEST_F(Mask, theLayerIsTheOneThatIsNamed) {
    polygon("[500000,5538650],[500002,5538650],[500002,5538648],[500000,5538650]", "EPSG::25832");
    EXPECT_NO_THROW(mask("side.geojson", "side"));
    EXPECT_EQ(refused<OptionError>([this] { mask("side.geojson", "roofs"); }),
              "The mask " + quoted("side.geojson") + " has no layer 'roofs'; it has 'side'.");
}

class Ndvi : public SideTest {
  protected:
    void SetUp() override {
        SideTest::SetUp();
        dem({.cols = 4});
    }
    void scaled(GDALDataType type, const std::vector<double>& values, double scale, double offset) {
        const GDALDatasetH dataset = create(path("side.tif"), {.cols = 4, .type = type, .values = values});
        GDALSetRasterScale(GDALGetRasterBand(dataset, 1), scale);
        GDALSetRasterOffset(GDALGetRasterBand(dataset, 1), offset);
        GDALClose(dataset);
    }
    std::string refusal() {
        return refused<InputError>([this] { ndvi(); });
    }
};

TEST_F(Ndvi, valuesAsTheyAre) {
    write(path("side.tif"), {.cols = 4, .values = {-1, 0.25, none, 1}});
    expect_values(ndvi(), {-1, 0.25, none, 1});
    EXPECT_TRUE(warnings().empty());
}

TEST_F(Ndvi, scaledProducts) {
    scaled(GDT_Int16, {-10000, 0, 2500, 10000}, 0.0001, 0);
    expect_near(ndvi(), {-1, 0, 0.25, 1}, 1e-12);
    scaled(GDT_Byte, {0, 50, 125, 250}, 0.008, -1);
    expect_near(ndvi(), {-1, -0.6, 0, 1}, 1e-12);
}

TEST_F(Ndvi, roundingIsForgiven) {
    write(path("side.tif"), {.cols = 4, .values = {-1.0000005, 0, 0, 1.0000005}});
    expect_values(ndvi(), {-1, 0, 0, 1});
}

TEST_F(Ndvi, otherGridsAndGaps) {
    write(path("side.tif"),
          {.cols = 2, .rows = 2, .values = {0.2, 0.4, 0.2, 0.4}, .transform = {{0, 2, 0, 0, 0, -1}}});
    expect_near(ndvi(), {0.2, 0.25, 0.35, 0.4}, 1e-12);
    write(path("side.tif"), {.cols = 2, .values = {0.2, 0.4}});
    expect_values(ndvi(), {0.2, 0.4, none, none});
    EXPECT_EQ(warnings(),
              (std::vector<std::string>{"About 50 % of " + quoted("dem.tif") + " lies outside of the NDVI " +
                                        quoted("side.tif") + "; nothing is known of vegetation there."}));
}

TEST_F(Ndvi, cellsWithoutAValueAreSaid) {
    dem({.cols = 10, .rows = 10});
    RasterSpec spec{.cols = 10, .rows = 10};
    spec.values.assign(100, 0.1);
    std::fill_n(spec.values.begin(), 40, none);
    write(path("side.tif"), spec);
    (void)ndvi();
    EXPECT_EQ(warnings(),
              (std::vector<std::string>{"About 40 % of the cells have no value in the NDVI " +
                                        quoted("side.tif") + "; nothing is known of vegetation there."}));
}

TEST_F(Ndvi, undeclaredNodataIsNoIndex) {
    constexpr int side = 40;
    dem({.cols = side, .rows = side});
    for (const double collar : {-9999.0, 255.0}) {
        RasterSpec spec{.cols = side, .rows = side};
        for (int i = 0; i < side * side; ++i)
            spec.values.push_back(i / side < 12 ? collar : i / 1600.0);
        write(path("side.tif"), spec);
        const std::vector<double> values = ndvi();
        EXPECT_EQ(std::ranges::count_if(values, [](double value) { return std::isnan(value); }), 12 * side);
        EXPECT_EQ(values.back(), 1599 / 1600.0);
        ASSERT_EQ(warnings().size(), 2U);
        EXPECT_EQ(warnings()[0], "480 cells of the NDVI " + quoted("side.tif") + " have the value " +
                                     (collar < 0 ? "-9999" : "255") +
                                     " and lie at its edge, so they are treated as no data; declare that "
                                     "with gdal_edit.py -a_nodata " +
                                     (collar < 0 ? "-9999." : "255."));
        warnings_.clear();
    }
    RasterSpec elevations{.cols = side, .rows = side};
    elevations.values.assign(side * side, 100);
    std::fill_n(elevations.values.begin(), 10 * side, 0.1);
    write(path("side.tif"), elevations);
    expect_has(refusal(), "has the value 100,");
    EXPECT_TRUE(warnings().empty());
}

TEST_F(Ndvi, valuesBlendedWithNoDataAreNoIndex) {
    constexpr int side = 40;
    dem({.cols = side, .rows = side});
    RasterSpec spec{.cols = side, .rows = side};
    spec.nodata = -9999;
    for (int i = 0; i < side * side; ++i)
        spec.values.push_back(i / side < 12 ? -9999 : i / side < 13 ? -3000 : i / 1600.0);
    write(path("side.tif"), spec);
    const std::vector<double> values = ndvi();
    EXPECT_EQ(std::ranges::count_if(values, [](double value) { return std::isnan(value); }), 14 * side);
    ASSERT_EQ(warnings().size(), 2U);
    expect_has(warnings()[0], "80 cells of the NDVI " + quoted("side.tif") +
                                  " have values blended with -9999 beside cells without data");
}

TEST_F(Ndvi, otherProductsAreRefused) {
    const auto text = [this](const std::string& value) {
        return "The NDVI " + quoted("side.tif") + " has the value " + value +
               ", and an NDVI lies between -1 and 1; if it stands for no data, declare that with "
               "gdal_edit.py -a_nodata " +
               value +
               ", else set the scale of a scaled product, for example with gdal_edit.py -scale 0.0001, or "
               "compute it as (NIR - red) / (NIR + red) and clamp it.";
    };
    write(path("side.tif"), {.cols = 4, .type = GDT_Int16, .values = {0, 1, 6000, 1}});
    EXPECT_EQ(refusal(), text("6000"));
    write(path("side.tif"), {.cols = 4, .values = {0, 1, 0, -1.5}});
    EXPECT_EQ(refusal(), text("-1.5"));
}

TEST_F(Ndvi, refusedAtOnceWhereTheMiddleRowTells) {
    dem({.cols = 1, .rows = 3});
    write(path("side.tif"), {.rows = 3, .values = {0, 2, 0}});
    expect_has(refused<InputError>([this] { (void)open_ndvi(path("side.tif"), grid_, callbacks_); }),
               "has the value 2,");
    write(path("side.tif"), {.rows = 3, .values = {2, 0, 0}});
    const auto source = open_ndvi(path("side.tif"), grid_, callbacks_);
    std::vector<double> row(1);
    source->read(whole_rows(*source, 2, 1), row);
    EXPECT_EQ(row[0], 0);
    expect_has(refused<InputError>([&] { source->read(whole_rows(*source, 0, 1), row); }),
               "has the value 2,");
}

}  // namespace
}  // namespace d2b::reading

#include "dem2buildings/error.hpp"
#include "read/side_fixture.hpp"

namespace d2b::test {
namespace {

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

TEST_F(Mask, subDatasetsAreNamed) {
    for (int i = 1; i <= 2; ++i)
        write(path("parts.gpkg"), {.type = GDT_Byte,
                                   .values = {1},
                                   .driver = "GPKG",
                                   .creation = {"RASTER_TABLE=part" + std::to_string(i),
                                                i == 1 ? "APPEND_SUBDATASET=NO" : "APPEND_SUBDATASET=YES"}});
    expect_has(refused<InputError>([this] { mask("parts.gpkg"); }),
               quoted("parts.gpkg") + " only holds sub-datasets; give one of them as the source: GPKG:");
}

}  // namespace
}  // namespace d2b::test

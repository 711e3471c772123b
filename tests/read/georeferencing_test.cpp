#include <algorithm>
#include <limits>

#include <ogr_srs_api.h>

#include "dem2buildings/open_sources.hpp"
#include "read/rasters.hpp"

namespace d2b::test {
namespace {

class ReadGeoreference : public ReadTest {
  protected:
    /// An in-line VRT of one cell with the given text between its header and its band.
    static std::string vrt(const std::string& inner) {
        return "<VRTDataset rasterXSize=\"1\" rasterYSize=\"1\">" + inner +
               "<VRTRasterBand dataType=\"Byte\" band=\"1\"/></VRTDataset>";
    }
    static constexpr const char* placed = "<GeoTransform>0,1,0,0,0,-1</GeoTransform>";
};

TEST_F(ReadGeoreference, whatIsKnownBeforeReading) {
    write(path("dem.tif"),
          {.cols = 3, .rows = 2, .values = counting(6), .transform = {{4e5, 0.5, 0, 5e6, 0, -0.25}}});
    const std::unique_ptr<DemSource> source = open("dem.tif");
    const DemInfo& info = source->info();
    EXPECT_EQ(info.name, path("dem.tif"));
    EXPECT_EQ(info.rows, 2);
    EXPECT_EQ(info.cols, 3);
    EXPECT_EQ(info.transform, (AffineTransform{4e5, 0.5, 0, 5e6, 0, -0.25}));
    EXPECT_TRUE(info.georeferenced);
    EXPECT_EQ(info.driver, "GTiff");
    EXPECT_EQ(info.band_unit, "");
    EXPECT_TRUE(warnings_.empty());
}

TEST_F(ReadGeoreference, theCrsIsWrittenAsWkt2) {
    write(path("dem.tif"), {.values = {1}});
    const std::string wkt = open("dem.tif")->info().crs_wkt;
    EXPECT_EQ(wkt.rfind("PROJCRS[\"ETRS89 / UTM zone 32N\"", 0), 0U) << wkt;
    expect_has(wkt, "ID[\"EPSG\",25832]");
    EXPECT_EQ(wkt.find('\n'), std::string::npos);
}

TEST_F(ReadGeoreference, rotatedSouthUpAndObliqueTransformsAreKept) {
    for (const AffineTransform& transform : std::vector<AffineTransform>{
             {10, 1, 1, 20, 1, -1}, {10, 2, 0, 20, 0, 3}, {10, 0, 2, 20, 2, 0}, {10, -1, 0.25, 20, 0.5, 1}}) {
        write(path("dem.tif"), {.cols = 2, .rows = 2, .values = counting(4), .transform = transform});
        EXPECT_EQ(open("dem.tif")->info().transform, transform);
        expect_values(values("dem.tif"), {0, 1, 2, 3});
    }
}

TEST_F(ReadGeoreference, withoutTransformTheCoordinatesArePixels) {
    write(path("dem.tif"), {.values = {1}, .transform = {}});
    const std::unique_ptr<DemSource> source = open("dem.tif");
    EXPECT_FALSE(source->info().georeferenced);
    EXPECT_EQ(source->info().transform, (AffineTransform{0, 1, 0, 0, 0, -1}));
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_EQ(warnings_[0],
              quoted("dem.tif") + " has no georeferencing; coordinates are columns and, upwards, rows.");
}

TEST_F(ReadGeoreference, withoutCrsLengthsArePlain) {
    write(path("dem.tif"), {.values = {1}, .crs = ""});
    EXPECT_EQ(open("dem.tif")->info().crs_wkt, "");
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_EQ(warnings_[0], quoted("dem.tif") +
                                " has no coordinate reference system; lengths are taken as plain "
                                "units; give it with -a_srs.");
}

TEST_F(ReadGeoreference, theUsersCrsTakesThePlaceOfTheFiles) {
    write(path("dem.tif"), {.values = {1}});
    options_.crs = "EPSG:28992";
    expect_has(open("dem.tif")->info().crs_wkt, "ID[\"EPSG\",28992]");
    options_.crs = "EPSG:25832+7837";
    expect_has(open("dem.tif")->info().crs_wkt, "COMPOUNDCRS[");
    options_.crs = "+proj=utm +zone=33 +datum=WGS84";
    expect_has(open("dem.tif")->info().crs_wkt, "zone 33");
    EXPECT_TRUE(warnings_.empty());
}

TEST_F(ReadGeoreference, whatIsNoCrsIsRefused) {
    write(path("dem.tif"), {.values = {1}});
    options_.crs = "EPSG:999999";
    const std::string text = message<OptionError>("dem.tif");
    EXPECT_EQ(text.rfind("-a_srs EPSG:999999 is not a coordinate reference system (", 0), 0U) << text;
    expect_has(text, "not found");
    expect_has(text, "); give a code such as EPSG:25832, WKT, PROJJSON or a PROJ string.");
}

TEST_F(ReadGeoreference, aCrsIsNotReadFromAFile) {
    write(path("dem.tif"), {.values = {1}});
    write_text(path("crs.prj"), "+proj=utm +zone=33 +datum=WGS84");
    options_.crs = path("crs.prj");
    expect_has(message<OptionError>("dem.tif"), "is not a coordinate reference system");
}

TEST_F(ReadGeoreference, aSingularTransformIsRefused) {
    options_.source = vrt("<GeoTransform>5,1,2,6,2,4</GeoTransform>");
    EXPECT_EQ(message<InputError>(),
              "The transform of '" + options_.source +
                  "' (5, 1, 2, 6, 2, 4) gives its cells no area; correct it, for example with "
                  "gdal_edit.py -a_ullr.");
    options_.source = vrt("<GeoTransform>5,0,0,6,0,-1</GeoTransform>");
    expect_has(message<InputError>(), "gives its cells no area");
    options_.source = vrt("<GeoTransform>5,0.1,0.3,6,0.2,0.6</GeoTransform>");  // singular but for rounding
    expect_has(message<InputError>(), "gives its cells no area");
    options_.source = vrt("<GeoTransform>nan,1,0,6,0,-1</GeoTransform>");
    expect_has(message<InputError>(), "gives its cells no area");
    options_.source = vrt("<GeoTransform>5,inf,0,6,0,-1</GeoTransform>");
    expect_has(message<InputError>(), "gives its cells no area");
}

TEST_F(ReadGeoreference, smallCellsAreNoSingularTransform) {
    options_.source = vrt("<GeoTransform>5,1e-9,0,6,0,-1e-9</GeoTransform>");
    EXPECT_EQ(open()->info().transform, (AffineTransform{5, 1e-9, 0, 6, 0, -1e-9}));
}

TEST_F(ReadGeoreference, groundControlPointsAloneAreRefused) {
    options_.source = vrt("<GCPList><GCP Id=\"a\" Pixel=\"0\" Line=\"0\" X=\"1\" Y=\"1\"/></GCPList>");
    EXPECT_EQ(message<InputError>(),
              "'" + options_.source +
                  "' is placed by ground control points only; turn it into a regular grid with "
                  "gdalwarp first.");
}

TEST_F(ReadGeoreference, rationalPolynomialsAloneAreRefused) {
    const std::string rpc = R"(<Metadata domain="RPC"><MDI key="LINE_OFF">1</MDI></Metadata>)";
    options_.source = vrt(rpc);
    EXPECT_EQ(
        message<InputError>(),
        "'" + options_.source +
            "' is placed by rational polynomials (RPCs) only; turn it into a regular grid with gdalwarp "
            "-rpc first.");
    options_.source = vrt(placed + rpc);
    EXPECT_TRUE(open()->info().georeferenced);
}

TEST_F(ReadGeoreference, geolocationArraysAloneAreRefused) {
    const std::string arrays =
        R"(<Metadata domain="GEOLOCATION"><MDI key="X_DATASET">x.tif</MDI></Metadata>)";
    options_.source = vrt(arrays);
    EXPECT_EQ(message<InputError>(),
              "'" + options_.source +
                  "' is placed by geolocation arrays only; turn it into a regular grid with gdalwarp -geoloc "
                  "first.");
    options_.source = vrt(placed + arrays);
    EXPECT_TRUE(open()->info().georeferenced);
}

TEST_F(ReadGeoreference, aCrsWithoutAPlaneIsRefused) {
    write(path("dem.tif"), {.values = {1}});
    for (const auto& [code, name] : {std::pair("EPSG:5773", "EGM96 height"), {"EPSG:4978", "WGS 84"}}) {
        options_.crs = code;
        EXPECT_EQ(
            message<OptionError>("dem.tif"),
            "-a_srs " + options_.crs + " is '" + name +
                "', which has no plane coordinates; give a projected or geographic coordinate reference "
                "system.");
        options_.crs.clear();
        const std::string own =
            vrt(std::string(placed) + "<SRS dataAxisToSRSAxisMapping=\"1\">" + code + "</SRS>");
        options_.source = own;
        EXPECT_EQ(
            message<InputError>(),
            "The coordinate reference system of '" + own + "' is '" + name +
                "', which has no plane coordinates; correct it with gdal_edit.py -a_srs, or for the DEM "
                "with -a_srs.");
        options_.crs = "EPSG:25832";
        EXPECT_TRUE(open()->info().georeferenced);
        options_.source.clear();
    }
}

TEST_F(ReadGeoreference, aBareNumberIsNoCrs) {
    write(path("dem.tif"), {.values = {1}});
    options_.crs = "4326";
    EXPECT_EQ(message<OptionError>("dem.tif"),
              "-a_srs 4326 is not a coordinate reference system; write -a_srs EPSG:4326 if that is meant.");
}

/// Else a picture of 200 rows reaches beyond the south pole.
TEST_F(ReadGeoreference, pixelsAreNoDegrees) {
    write(path("picture.tif"), {.values = {1}, .transform = {}, .crs = "EPSG:4326"});
    EXPECT_EQ(open("picture.tif")->info().crs_wkt, "");
    ASSERT_EQ(warnings_.size(), 2U);
    EXPECT_EQ(
        warnings_[1],
        quoted("picture.tif") +
            " has a coordinate reference system in degrees, but its coordinates are columns and rows; it is "
            "ignored.");
}

/// 5 columns and 4 rows of cells 2 wide and 3 high; x from 100 to 110, y from 488 to 500. Row 1 starts
/// with 10.
class ReadWindow : public ReadTest {
  protected:
    void SetUp() override {
        ReadTest::SetUp();
        std::vector<double> values;
        for (int row = 0; row < 4; ++row)
            for (int col = 0; col < 5; ++col)
                values.push_back(10 * row + col);
        spec_ = {.cols = 5, .rows = 4, .values = values, .transform = {{100, 2, 0, 500, 0, -3}}};
        write(path("dem.tif"), spec_);
    }
    RasterSpec spec_;
};

TEST_F(ReadWindow, allOfTheRasterByDefault) {
    EXPECT_EQ(open("dem.tif")->info().window, (Window{0, 0, 4, 5}));
}

TEST_F(ReadWindow, inCells) {
    options_.source_window = {1, 2, 3, 2};
    const std::unique_ptr<DemSource> source = open("dem.tif");
    EXPECT_EQ(source->info().window, (Window{2, 1, 2, 3}));
    EXPECT_EQ(source->info().rows, 4);
    EXPECT_EQ(source->info().cols, 5);
    EXPECT_EQ(source->info().transform, (AffineTransform{100, 2, 0, 500, 0, -3}));
    expect_values(read_all(*source), {21, 22, 23, 31, 32, 33});
}

TEST_F(ReadWindow, byCorners) {
    options_.projected_window = {102, 494, 106, 488};
    expect_values(values("dem.tif"), {21, 22, 31, 32});
}

TEST_F(ReadWindow, byExtent) {
    options_.extent = {102, 488, 106, 494};
    const std::unique_ptr<DemSource> source = open("dem.tif");
    EXPECT_EQ(source->info().window, (Window{2, 1, 2, 2}));
    expect_values(read_all(*source), {21, 22, 31, 32});
}

TEST_F(ReadWindow, centresOnWestAndSouthEdgesAreInside) {
    // Centres: x 101, 103, ...; y 498.5, 495.5, 492.5, 489.5.
    options_.extent = {103, 492.5, 105, 495.5};
    EXPECT_EQ(open("dem.tif")->info().window, (Window{2, 1, 1, 1}));
    options_.extent = {102.9, 492.4, 105.1, 495.6};
    EXPECT_EQ(open("dem.tif")->info().window, (Window{1, 1, 2, 2}));
    options_.extent = {103.1, 488, 106.9, 500};
    EXPECT_EQ(open("dem.tif")->info().window, (Window{0, 2, 4, 1}));
}

TEST_F(ReadWindow, neighboursShareNoCell) {
    options_.extent = {100, 488, 105, 500};
    EXPECT_EQ(open("dem.tif")->info().window, (Window{0, 0, 4, 2}));
    options_.extent = {105, 488, 110, 500};
    EXPECT_EQ(open("dem.tif")->info().window, (Window{0, 2, 4, 3}));
}

TEST_F(ReadWindow, whatLiesOutsideIsClipped) {
    options_.extent = {-1e300, 496.9, 104, 1e300};
    EXPECT_EQ(open("dem.tif")->info().window, (Window{0, 0, 1, 2}));
}

TEST_F(ReadWindow, southUpAndMirrored) {
    spec_.transform = {{110, -2, 0, 488, 0, 3}};
    write(path("turned.tif"), spec_);
    options_.extent = {102, 488, 106, 494};
    // x of the centres: 109, 107, 105, 103, 101; y: 489.5, 492.5, 495.5, 498.5.
    EXPECT_EQ(open("turned.tif")->info().window, (Window{0, 2, 2, 2}));
    expect_values(values("turned.tif"), {2, 3, 12, 13});
    options_.extent = {103, 489.5, 105, 492.5};
    expect_values(values("turned.tif"), {3});
}

TEST_F(ReadWindow, pixelCoordinatesHaveYUpwards) {
    spec_.transform.reset();
    write(path("plain.tif"), spec_);
    options_.extent = {1, -2, 3, 0};
    expect_values(values("plain.tif"), {1, 2, 11, 12});
}

TEST_F(ReadWindow, cellsMustBeWholeNumbers) {
    options_.source_window = {0, 0, 2.5, 1};
    EXPECT_EQ(message<OptionError>("dem.tif"),
              "-srcwin 0 0 2.5 1 must be whole numbers of cells (column row columns rows); the raster has 5 "
              "columns "
              "and 4 rows.");
    options_.source_window = {0, 0, none, 1};
    expect_has(message<OptionError>("dem.tif"), "must be whole numbers of cells");
}

TEST_F(ReadWindow, cellsMustLieInside) {
    for (const auto& window : std::vector<std::array<double, 4>>{{3, 0, 3, 1},
                                                                 {0, 3, 1, 2},
                                                                 {-1, 0, 2, 2},
                                                                 {0, -1, 2, 2},
                                                                 {0, 0, 0, 1},
                                                                 {0, 0, 1, 0},
                                                                 {0, 0, 1e300, 1}}) {
        options_.source_window = window;
        expect_has(message<OptionError>("dem.tif"),
                   "does not lie inside the raster; the raster has 5 columns and 4 rows.");
    }
    options_.source_window = {3, 0, 3, 1};
    expect_has(message<OptionError>("dem.tif"), "-srcwin 3 0 3 1 (column row columns rows)");
}

TEST_F(ReadWindow, nothingInside) {
    options_.extent = {0, 488, 100, 500};
    EXPECT_EQ(message<OptionError>("dem.tif"),
              "-te 0 488 100 500 holds no cell centre of the raster, which extends from 100 to 110 in x and "
              "from 488 "
              "to 500 in y.");
    options_.extent.reset();
    options_.projected_window = {103.2, 500, 104.8, 488};  // between two columns of centres
    expect_has(message<OptionError>("dem.tif"), "-projwin 103.2 500 104.8 488 holds no cell centre");
}

TEST_F(ReadWindow, anotherOrderIsTold) {
    options_.extent = {488, 102, 494, 106};
    expect_has(message<OptionError>("dem.tif"),
               "from 488 to 500 in y; x comes before y, so write -te 102 488 106 494.");
    EXPECT_TRUE(warnings_.empty());
    options_.extent = {102, 106, 488, 494};
    EXPECT_EQ(open("dem.tif")->info().window, (Window{2, 1, 2, 4}));
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_EQ(
        warnings_[0],
        "-te 102 106 488 494 (xmin ymin xmax ymax) reaches beyond the raster; if it is xmin xmax ymin ymax, "
        "as QGIS has it, write -te 102 488 106 494.");
}

TEST_F(ReadWindow, cornersInOrder) {
    options_.projected_window = {102, 488, 106, 494};
    expect_has(message<OptionError>("dem.tif"),
               "-projwin 102 488 106 494 must be the upper left and the lower right");
    options_.projected_window.reset();
    options_.extent = {102, 494, 106, 488};
    expect_has(message<OptionError>("dem.tif"), "-te 102 494 106 488 must be xmin ymin xmax ymax");
    options_.extent = {none, 488, 106, 494};
    expect_has(message<OptionError>("dem.tif"), "must be xmin ymin xmax ymax");
}

TEST_F(ReadWindow, onlyOne) {
    options_.extent = {102, 488, 106, 494};
    options_.source_window = {0, 0, 1, 1};
    EXPECT_EQ(message<OptionError>("dem.tif"),
              "-srcwin, -projwin and -te exclude each other; give only one of them.");
}

TEST_F(ReadWindow, coordinatesOfARotatedRaster) {
    spec_.transform = {{100, 2, 1, 500, 1, -2}};
    write(path("rotated.tif"), spec_);
    options_.extent = {102, 488, 106, 494};
    EXPECT_EQ(message<OptionError>("rotated.tif"),
              "-te 102 488 106 494 cannot be used, since the rows of the raster do not run along the x axis; "
              "give the "
              "window in cells with -srcwin.");
    options_.extent.reset();
    options_.source_window = {4, 3, 1, 1};
    expect_values(values("rotated.tif"), {34});
}

}  // namespace
}  // namespace d2b::test

#include <algorithm>
#include <limits>

#include <ogr_srs_api.h>

#include "dem2buildings/open_sources.hpp"
#include "read/rasters.hpp"

namespace d2b::test {
namespace {

class ReadGeoreference : public ReadTest {
  protected:
    /// An in-line VRT of one cell with what is given between its header and its band.
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
    expect_has(open("dem.tif")->info().crs_wkt, "PROJCRS[\"Amersfoort / RD New\"");
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
    EXPECT_EQ(warnings_[1],
              quoted("picture.tif") +
                  " has a coordinate reference system in degrees, which columns and rows are not; it is left "
                  "out.");
}

}  // namespace
}  // namespace d2b::test

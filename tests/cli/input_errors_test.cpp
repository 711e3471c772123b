#include <cpl_string.h>

#include "cli/cli_test_case.hpp"

namespace d2b::test {
namespace {

class InputErrors : public CliTest {
  protected:
    void failed(const std::string& part, const std::string& source, Arguments arguments = {}) const {
        arguments.insert(arguments.end(), {"--", source, "out.gpkg"});
        expect_error(1, part, arguments);
    }
};

TEST_F(InputErrors, missingSource) {
    failed("'none.tif' cannot be opened as a raster: ", "none.tif");
    failed("'nowhere/none.tif' cannot be opened as a raster: ", "nowhere/none.tif");
    failed("'/vsizip/none.zip/a.tif' cannot be opened as a raster: ", "/vsizip/none.zip/a.tif");
}

TEST_F(InputErrors, notARaster) {
    write_text(path("text.tif"), "no raster at all");
    failed("'text.tif' cannot be opened as a raster: ", "text.tif");
    write_text(path("empty.tif"), "");
    failed("'empty.tif' cannot be opened as a raster: ", "empty.tif");
}

TEST_F(InputErrors, truncatedGeoTiff) {
    RasterSpec spec = blocks();
    spec.cols = spec.rows = 300;  // in several strips
    spec.values = counting(90000);
    write(path("whole.tif"), spec);
    const std::string bytes = read_bytes(path("whole.tif"));
    write_text(path("short.tif"), bytes.substr(0, bytes.size() - 600));
    failed("'short.tif' cannot be read: ", "short.tif");
    failed("; the file may be truncated or damaged.", "short.tif");
    write_text(path("head.tif"), bytes.substr(0, 6));
    failed("'head.tif' cannot be opened as a raster: ", "head.tif");
}

TEST_F(InputErrors, truncatedCompressedTown) {
    const std::string bytes = read_bytes(sample("town.tif"));
    write_text(path("short.tif"), bytes.substr(0, bytes.size() * 2 / 3));
    failed("short.tif' cannot be ", "short.tif");
}

TEST_F(InputErrors, truncatedEnvi) {
    RasterSpec spec = blocks();
    spec.driver = "ENVI";
    write(path("grid.img"), spec);
    write_text(path("grid.img"), read_bytes(path("grid.img")).substr(0, 2000));
    failed("'grid.img' has 2000 bytes, but its header promises 2400; it is truncated, so copy it again.",
           "grid.img");
}

TEST_F(InputErrors, complexBand) {
    RasterSpec spec = blocks();
    spec.type = GDT_CFloat32;
    write(path("complex.tif"), spec);
    failed(
        "Band 1 of 'complex.tif' holds complex numbers, which are not elevations; choose another band with "
        "-b.",
        "complex.tif");
}

TEST_F(InputErrors, noSuchBand) {
    write(path("dem.tif"), blocks());
    failed("'dem.tif' has no band 2; its bands are numbered from 1 to 1.", "dem.tif", {"-b", "2"});
}

TEST_F(InputErrors, groundControlPointsOnly) {
    RasterSpec spec = blocks();
    spec.transform.reset();
    spec.crs = "";
    const GDALDatasetH dataset = create(path("gcps.tif"), spec);
    std::array<GDAL_GCP, 3> points{};
    for (std::size_t i = 0; i < points.size(); ++i) {
        GDALInitGCPs(1, &points[i]);
        points[i].dfGCPPixel = i == 1 ? 30 : 0;
        points[i].dfGCPLine = i == 2 ? 20 : 0;
        points[i].dfGCPX = 391000 + points[i].dfGCPPixel;
        points[i].dfGCPY = 5820000 - points[i].dfGCPLine;
    }
    ASSERT_EQ(GDALSetGCPs(dataset, 3, points.data(), ""), CE_None);
    for (GDAL_GCP& point : points)
        GDALDeinitGCPs(1, &point);
    GDALClose(dataset);
    failed(
        "'gcps.tif' is placed by ground control points only; turn it into a regular grid with gdalwarp "
        "first.",
        "gcps.tif");
}

TEST_F(InputErrors, rationalPolynomialsOrGeolocationArraysOnly) {
    RasterSpec spec = blocks();
    spec.transform.reset();
    spec.crs = "";
    const auto with_metadata = [&](const std::string& name, const char* domain, const Arguments& items) {
        const GDALDatasetH dataset = create(path(name), spec);
        CPLStringList list;
        for (const std::string& item : items)
            list.AddString(item.c_str());
        ASSERT_EQ(GDALSetMetadata(dataset, list.List(), domain), CE_None);
        GDALClose(dataset);
    };
    std::string zeros = "1";
    for (int i = 1; i < 20; ++i)
        zeros += " 0";
    with_metadata(
        "rpc.tif", "RPC",
        {"LINE_OFF=10", "SAMP_OFF=10", "LAT_OFF=52", "LONG_OFF=4", "HEIGHT_OFF=0", "LINE_SCALE=10",
         "SAMP_SCALE=10", "LAT_SCALE=.001", "LONG_SCALE=.001", "HEIGHT_SCALE=100", "LINE_NUM_COEFF=" + zeros,
         "LINE_DEN_COEFF=" + zeros, "SAMP_NUM_COEFF=" + zeros, "SAMP_DEN_COEFF=" + zeros});
    with_metadata("arrays.tif", "GEOLOCATION", {"X_DATASET=x.tif", "Y_DATASET=y.tif", "X_BAND=1"});
    failed(
        "'rpc.tif' is placed by rational polynomials (RPCs) only; turn it into a regular grid with gdalwarp "
        "-rpc first.",
        "rpc.tif");
    failed(
        "'arrays.tif' is placed by geolocation arrays only; turn it into a regular grid with gdalwarp "
        "-geoloc first.",
        "arrays.tif");
    // The same holds for what is given beside the DEM.
    write(path("dem.tif"), blocks());
    failed("'rpc.tif' is placed by rational polynomials (RPCs) only", "dem.tif",
           {"-preset", "buildings", "-mask", "rpc.tif"});
}

TEST_F(InputErrors, targetsThatTearTheDemApart) {
    RasterSpec spec = blocks();
    spec.crs = "EPSG:4326";
    spec.transform = std::array<double, 6>{179.9999, 1e-5, 0, -17, 0, -1e-5};
    write(path("fiji.tif"), spec);
    failed("'fiji.tif' cannot be converted to 'WGS 84 / Pseudo-Mercator', which splits the area", "fiji.tif",
           {"-t_srs", "EPSG:3857"});
    run_well({"-q", "-t_srs", "EPSG:32760", "fiji.tif", "fiji.gpkg"});
}

TEST_F(InputErrors, aCrsOfHeights) {
    RasterSpec spec = blocks();
    write(path("dem.tif"), spec);
    expect_error(2, "-a_srs EPSG:5773 is 'EGM96 height', which has no plane coordinates; give a projected or",
                 {"-a_srs", "EPSG:5773", "dem.tif", "out.gpkg"});
    expect_error(2, "-a_srs EPSG:4978 is 'WGS 84', which has no plane coordinates",
                 {"-a_srs", "EPSG:4978", "dem.tif", "out.gpkg"});
    expect_error(2, "'EGM96 height' has no plane coordinates to transform to",
                 {"-t_srs", "EPSG:5773", "dem.tif", "out.gpkg"});
    write_text(path("heights.vrt"), R"(<VRTDataset rasterXSize="30" rasterYSize="20"><SRS>EPSG:5773</SRS>
        <GeoTransform>391000,1,0,5820000,0,-1</GeoTransform><VRTRasterBand dataType="Float32" band="1">
        <SimpleSource><SourceFilename relativeToVRT="1">dem.tif</SourceFilename><SourceBand>1</SourceBand>
        </SimpleSource></VRTRasterBand></VRTDataset>)");
    failed(
        "The coordinate reference system of 'heights.vrt' is 'EGM96 height', which has no plane coordinates; "
        "correct it with gdal_edit.py -a_srs, or for the DEM with -a_srs.",
        "heights.vrt");
    run_well({"-q", "-a_srs", "EPSG:25833", "heights.vrt", "out.gpkg"});
}

TEST_F(InputErrors, singularTransform) {
    RasterSpec spec = blocks();
    spec.transform = std::array<double, 6>{391000, 1, 2, 5820000, 2, 4};
    write(path("flat.tif"), spec);
    failed("The transform of 'flat.tif' (391000, 1, 2, 5820000, 2, 4) gives its cells no area; correct it",
           "flat.tif");
}

TEST_F(InputErrors, scaleOfNothing) {
    write(path("source.tif"), blocks());
    write_text(path("zero.vrt"),
               R"(<VRTDataset rasterXSize="30" rasterYSize="20"><VRTRasterBand dataType="Float32"
        band="1"><Scale>0</Scale><SimpleSource><SourceFilename relativeToVRT="1">source.tif</SourceFilename>
        <SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>)");
    expect_error(1, "'zero.vrt' has the scale 0 and the offset 0, which give no elevations",
                 {"zero.vrt", "out.gpkg"}, {}, 2);
}

TEST_F(InputErrors, nothingOnStdin) {
    failed("The standard input is empty; pipe a raster into it or give a file.", "/vsistdin/");
}

TEST_F(InputErrors, stdinWithoutRoom) {
    const Arguments arguments{"--config", "CPL_TMPDIR=/nonexistent", "/vsistdin/", "out.gpkg"};
    expect_error(1, "set CPL_TMPDIR to a folder with room.", arguments,
                 {.stdin_text = read_bytes(sample("degrees.tif"))});
}

TEST_F(InputErrors, cutline) {
    write(path("dem.tif"), blocks());
    failed("The cutline 'none.shp' cannot be opened: ", "dem.tif", {"-cutline", "none.shp"});
    write_text(path("points.geojson"), R"({"type": "Point", "coordinates": [13, 52]})");
    failed("points.geojson", "dem.tif", {"-cutline", "points.geojson"});
}

}  // namespace
}  // namespace d2b::test

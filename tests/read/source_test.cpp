#include <cpl_vsi.h>

#include "dem2buildings/open_sources.hpp"
#include "read/rasters.hpp"

namespace d2b::test {
namespace {

class ReadSource : public ReadTest {};

TEST_F(ReadSource, aMosaicAsText) {
    write(path("west.tif"), {.cols = 2, .values = {1, 2}});
    write(path("east.tif"), {.cols = 1, .values = {3}});
    const auto part = [&](const std::string& name, int at, int cols) {
        const std::string size = "\" ySize=\"1\" xSize=\"" + std::to_string(cols) + "\" yOff=\"0\" xOff=\"";
        return "<SimpleSource><SourceFilename>" + path(name) +
               "</SourceFilename><SourceBand>1</SourceBand><SrcRect a=\"" + size + "0\"/><DstRect a=\"" +
               size + std::to_string(at) + "\"/></SimpleSource>";
    };
    options_.source =
        "<VRTDataset rasterXSize=\"4\" rasterYSize=\"1\"><GeoTransform>0,1,0,0,0,-1</GeoTransform>"
        "<VRTRasterBand dataType=\"Float64\" band=\"1\"><NoDataValue>-1</NoDataValue>" +
        part("west.tif", 0, 2) + part("east.tif", 3, 1) + "</VRTRasterBand></VRTDataset>";
    expect_values(values(), {1, 2, none, 3});
    EXPECT_EQ(open()->info().driver, "VRT");
}

TEST_F(ReadSource, aFileInAnArchive) {
    write(path("dem.tif"), {.cols = 2, .values = {5, 6}});
    write_text("/vsizip/" + path("dem.zip") + "/dem.tif", read_bytes(path("dem.tif")));
    options_.source = "/vsizip/" + path("dem.zip") + "/dem.tif";
    expect_values(values(), {5, 6});
}

TEST_F(ReadSource, aTextGrid) {
    write_text(
        path("dem.asc"),
        "ncols 2\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 5\nNODATA_value -9999\n1.5 -9999\n3 4\n");
    expect_values(values("dem.asc"), {1.5, none, 3, 4});
    EXPECT_EQ(open("dem.asc")->info().transform, (AffineTransform{10, 5, 0, 30, 0, -5}));
}

TEST_F(ReadSource, theFormatCanBePrescribed) {
    write(path("dem.tif"), {.values = {5}});
    options_.drivers = {"PNG", "GTiff"};
    expect_values(values("dem.tif"), {5});
    options_.drivers = {"PNG"};
    const std::string said = message<InputError>("dem.tif");
    EXPECT_TRUE(said.starts_with(quoted("dem.tif") + " cannot be opened as a raster: `" + path("dem.tif") +
                                 "' not recognized as "))
        << said;
    EXPECT_TRUE(said.ends_with("supported file format.")) << said;  // "a", from GDAL 3.10 on "being in a"
    options_.drivers = {"NoSuchFormat"};
    EXPECT_EQ(message<OptionError>("dem.tif"),
              "-if NoSuchFormat names no format of this GDAL; gdalinfo --formats lists them.");
}

TEST_F(ReadSource, openOptionsReachTheDriver) {
    options_.open_options = {"DATATYPE=Float64"};
    write_text(path("dem.asc"), "ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n0.1\n");
    expect_values(values("dem.asc"), {0.1});
    options_.open_options = {};
    expect_values(values("dem.asc"), {static_cast<double>(0.1F)});
}

TEST_F(ReadSource, anUnknownOpenOptionIsAWarningOfGdals) {
    write(path("dem.tif"), {.values = {5}});
    options_.open_options = {"NO_SUCH=1"};
    expect_values(values("dem.tif"), {5});
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_EQ(warnings_[0], "GDAL: driver GTiff does not support open option NO_SUCH.");
}

TEST_F(ReadSource, openOptionsHaveAForm) {
    write(path("dem.tif"), {.values = {5}});
    for (const char* option : {"NUM_THREADS", "=2", ""}) {
        options_.open_options = {option};
        EXPECT_EQ(message<OptionError>("dem.tif"),
                  "-oo " + std::string(option) + " must have the form NAME=VALUE.");
    }
}

TEST_F(ReadSource, aBandThatIsNotThere) {
    write(path("dem.tif"), {.values = {5}, .bands = 3});
    for (const int band : {-1, 0, 4}) {
        options_.band = band;
        EXPECT_EQ(message<InputError>("dem.tif"), quoted("dem.tif") + " has no band " + std::to_string(band) +
                                                      "; its bands are numbered from 1 to 3.");
    }
}

TEST_F(ReadSource, complexNumbersAreRefused) {
    for (const GDALDataType type : {GDT_CInt16, GDT_CInt32, GDT_CFloat32, GDT_CFloat64}) {
        write(path("dem.tif"), {.type = type, .values = {5}});
        EXPECT_EQ(message<InputError>("dem.tif"),
                  "Band 1 of '" + path("dem.tif") +
                      "' holds complex numbers, which are no elevations; choose another band with -b.");
    }
}

TEST_F(ReadSource, aColourTableIsSaid) {
    const GDALDatasetH dataset = create(path("dem.tif"), {.cols = 2, .type = GDT_Byte, .values = {0, 1}});
    const GDALColorTableH colours = GDALCreateColorTable(GPI_RGB);
    const GDALColorEntry red{255, 0, 0, 255};
    GDALSetColorEntry(colours, 1, &red);
    GDALSetRasterColorTable(GDALGetRasterBand(dataset, 1), colours);
    GDALDestroyColorTable(colours);
    GDALClose(dataset);
    expect_values(values("dem.tif"), {0, 1});
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_EQ(warnings_[0], "Band 1 of '" + path("dem.tif") +
                                "' holds indices into a colour table; they are taken as elevations.");
}

/// Appends the images of GeoTIFF to one file.
void write_pages(const std::string& path, int pages) {
    for (int i = 1; i <= pages; ++i)
        write(path, {.values = {static_cast<double>(i)},
                     .creation = {i == 1 ? "BIGTIFF=NO" : "APPEND_SUBDATASET=YES"}});
}

TEST_F(ReadSource, aPageOfAFile) {
    write_pages(path("pages.tif"), 2);
    options_.source = "GTIFF_DIR:2:" + path("pages.tif");
    expect_values(values(), {2});
}

/// A GeoPackage with the rasters part1, part2, ...: opened as a whole it has sub-datasets and no band.
void write_collection(const std::string& path, int count) {
    for (int i = 1; i <= count; ++i)
        write(path, {.type = GDT_Byte,
                     .values = {static_cast<double>(i)},
                     .driver = "GPKG",
                     .creation = {"RASTER_TABLE=part" + std::to_string(i),
                                  i == 1 ? "APPEND_SUBDATASET=NO" : "APPEND_SUBDATASET=YES"}});
}

TEST_F(ReadSource, subDatasetsAloneAreNamed) {
    const std::string file = path("parts.gpkg");
    write_collection(file, 2);
    const std::string start = "'" + file + "' only holds sub-datasets; give one of them as the source: GPKG:";
    EXPECT_EQ(message<InputError>("parts.gpkg"), start + file + ":part1, GPKG:" + file + ":part2.");
    write_collection(file, 3);
    EXPECT_EQ(message<InputError>("parts.gpkg"),
              start + file + ":part1, GPKG:" + file + ":part2, GPKG:" + file + ":part3.");
    write_collection(file, 5);
    EXPECT_EQ(message<InputError>("parts.gpkg"),
              start + file + ":part1, GPKG:" + file + ":part2, GPKG:" + file + ":part3 and others.");
    options_.source = "GPKG:" + file + ":part2";
    EXPECT_EQ(values().at(0), 2);
}

TEST_F(ReadSource, noBandAtAll) {
    if (GDALGetDriverByName("PCIDSK") == nullptr)
        GTEST_SKIP() << "this GDAL has no driver that can write a raster without bands (PCIDSK)";
    write(path("none.pix"), {.bands = 0, .driver = "PCIDSK"});
    EXPECT_EQ(message<InputError>("none.pix"),
              quoted("none.pix") + " has no raster band; give another source.");
}

TEST_F(ReadSource, aHugeSparseFileIsReadInParts) {
    const int size = 1000000;
    RasterSpec spec{.cols = size, .rows = size, .type = GDT_Byte, .nodata = 0};
    spec.creation = {"SPARSE_OK=TRUE", "TILED=YES", "BLOCKXSIZE=4096", "BLOCKYSIZE=4096", "BIGTIFF=YES"};
    const GDALDatasetH dataset = create(path("huge.tif"), spec);
    GByte value = 42;
    ASSERT_EQ(GDALRasterIO(GDALGetRasterBand(dataset, 1), GF_Write, 999999, 999999, 1, 1, &value, 1, 1,
                           GDT_Byte, 0, 0),
              CE_None);
    GDALClose(dataset);
    options_.source_window = {999000, 999999, 1000, 1};
    std::vector<double> expected(1000, none);
    expected.back() = 42;
    expect_values(values("huge.tif"), expected);
}

TEST_F(ReadSource, aRowOfAHugeMosaic) {
    options_.source =
        "<VRTDataset rasterXSize=\"1000000\" "
        "rasterYSize=\"1000000\"><GeoTransform>0,1,0,0,0,-1</GeoTransform>"
        "<VRTRasterBand dataType=\"Float32\" "
        "band=\"1\"><NoDataValue>-9999</NoDataValue></VRTRasterBand></VRTDataset>";
    const std::unique_ptr<DemSource> source = open();
    EXPECT_EQ(source->info().window, (Window{0, 0, 1000000, 1000000}));
    std::vector<double> row(1000000, 1.0);
    source->read(whole_rows(*source, 999999, 1), row);
    expect_values(row, std::vector<double>(1000000, none));
}

}  // namespace
}  // namespace d2b::test

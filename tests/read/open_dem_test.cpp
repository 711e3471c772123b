#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sources.hpp"
#include "read/rasters.hpp"
#include "support/test_name.hpp"

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

TEST_F(ReadSource, theDateOfItsElevations) {
    const auto date = [&](const std::string& tag, const std::string& acquired) {
        write(path("dem.tif"), {.cols = 2, .values = {1, 2}});
        {
            const reading::DatasetOwner dataset(GDALOpen(path("dem.tif").c_str(), GA_Update));
            GDALSetMetadataItem(dataset.get(), "TIFFTAG_DATETIME", tag.empty() ? nullptr : tag.c_str(),
                                nullptr);
            GDALSetMetadataItem(dataset.get(), "ACQUISITIONDATETIME",
                                acquired.empty() ? nullptr : acquired.c_str(), "IMAGERY");
        }
        options_.source = path("dem.tif");
        return open()->info().date;
    };
    EXPECT_EQ(date("", ""), "");
    EXPECT_EQ(date("2024:05:31 12:00:00", ""), "2024-05-31");
    EXPECT_EQ(date("2024:05:31 12:00:00", "2019-07-01 10:00:00"), "2019-07-01");
    EXPECT_EQ(date("last summer", ""), "");
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
              "-if NoSuchFormat is not a format of this GDAL; gdalinfo --formats lists them.");
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
                      "' holds complex numbers, which are not elevations; choose another band with -b.");
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

namespace fs = std::filesystem;

/// Every test reads its standard input in a process of its own, for a process has only one.
class ReadStdin : public ReadTest {
  protected:
    void SetUp() override {
        ReadTest::SetUp();
        folder_ =
            fs::path(::testing::TempDir()) /
            ("d2b_read_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "spool");
        input_ = (folder_ / "input").string();
        options_.source = "/vsistdin/";
    }
    void TearDown() override {
        fs::remove_all(folder_);
        ReadTest::TearDown();
    }
    void begin(const std::string& spool_folder) {
        ASSERT_NE(std::freopen(input_.c_str(), "rb", stdin), nullptr);
        CPLSetConfigOption("CPL_TMPDIR", spool_folder.c_str());
    }
    [[nodiscard]] std::string spool() const { return (folder_ / "spool").string(); }
    [[nodiscard]] std::ptrdiff_t spooled() const {
        return std::distance(fs::directory_iterator(spool()), fs::directory_iterator());
    }
    /// Ends the process: 0 where nothing has failed so far.
    [[noreturn]] static void end() { std::_Exit(HasFailure() ? 1 : 0); }

    fs::path folder_;
    std::string input_;
};

TEST_F(ReadStdin, isKeptInATemporaryFileWhileItIsUsed) {
    // Beyond the first megabyte, which is all that GDAL itself keeps of its standard input.
    const int size = 600;
    write(input_, {.cols = size, .rows = size, .values = counting(size * size)});
    EXPECT_EXIT(
        {
            begin(spool());
            std::unique_ptr<DemSource> source = open();
            EXPECT_EQ(source->info().name, "/vsistdin/");
            EXPECT_EQ(spooled(), 1);
            std::vector<double> row(size);
            source->read(whole_rows(*source, 599, 1), row);
            expect_values(row, counting(size, 599 * 600));
            source->read(whole_rows(*source, 0, 1), row);
            expect_values(row, counting(size));
            source.reset();
            EXPECT_EQ(spooled(), 0);
            end();
        },
        ::testing::ExitedWithCode(0), "");
}

TEST_F(ReadStdin, whatIsNoRasterLeavesNothingBehind) {
    write_text(input_, "not a raster");
    EXPECT_EXIT(
        {
            begin(spool());
            expect_has(message<InputError>(), "'/vsistdin/' cannot be opened as a raster: ");
            EXPECT_EQ(spooled(), 0);
            end();
        },
        ::testing::ExitedWithCode(0), "");
}

TEST_F(ReadStdin, nothingCameIn) {
    write_text(input_, "");
    EXPECT_EXIT(
        {
            begin(spool());
            EXPECT_EQ(message<InputError>(),
                      "The standard input is empty; pipe a raster into it or give a file.");
            EXPECT_EQ(spooled(), 0);
            end();
        },
        ::testing::ExitedWithCode(0), "");
}

TEST_F(ReadStdin, noPlaceToKeepIt) {
    write_text(input_, "x");
    EXPECT_EXIT(
        {
            begin(spool() + "/none");
            EXPECT_EQ(message<OutputError>(),
                      "The standard input cannot be kept in a temporary file in '" + spool() +
                          "/none': No such file or directory; set CPL_TMPDIR to a folder with "
                          "room.");
            end();
        },
        ::testing::ExitedWithCode(0), "");
}

constexpr double invalid = std::numeric_limits<double>::quiet_NaN();

/// Elevations in memory.
class ReadArray : public testing::Test {
  protected:
    void SetUp() override {
        options_.crs = "EPSG:32632";
        callbacks_.on_warning = [this](const std::string& text) { warnings_.push_back(text); };
    }
    /// 3 rows and 4 columns, 10 * row + column, one after another.
    template <typename Value>
    ElevationArray array_of(std::vector<Value>& values, ValueType type) {
        for (int row = 0; row < 3; ++row)
            for (int col = 0; col < 4; ++col)
                values.push_back(static_cast<Value>(10 * row + col));
        ElevationArray array;
        array.name = "array";
        array.rows = 3;
        array.cols = 4;
        array.type = type;
        array.values = {values.data(), 4 * sizeof(Value), sizeof(Value)};
        array.transform = {{500000, 1, 0, 5538690, 0, -1}};
        return array;
    }
    /// All elevations of the window; 99 for NaN.
    std::vector<double> values(const ElevationArray& array) {
        const auto source = open_dem(array, options_, callbacks_);
        const Window window = source->info().window;
        std::vector<double> read(static_cast<std::size_t>(window.rows) *
                                 static_cast<std::size_t>(window.cols));
        source->read(window, read);
        for (double& value : read)
            value = std::isnan(value) ? 99 : value;
        return read;
    }
    template <typename Value>
    void expect_all(ValueType type) {
        std::vector<Value> cells;
        const ElevationArray array = array_of(cells, type);
        EXPECT_EQ(values(array), (std::vector<double>{0, 1, 2, 3, 10, 11, 12, 13, 20, 21, 22, 23}));
    }

    ReadOptions options_;
    std::vector<std::string> warnings_;
    Callbacks callbacks_;
};

TEST_F(ReadArray, valuesOfEveryType) {
    expect_all<std::int8_t>(ValueType::int8);
    expect_all<std::uint8_t>(ValueType::uint8);
    expect_all<std::int16_t>(ValueType::int16);
    expect_all<std::uint16_t>(ValueType::uint16);
    expect_all<std::int32_t>(ValueType::int32);
    expect_all<std::uint32_t>(ValueType::uint32);
    expect_all<std::int64_t>(ValueType::int64);
    expect_all<std::uint64_t>(ValueType::uint64);
    expect_all<float>(ValueType::float32);
    expect_all<double>(ValueType::float64);
}

TEST_F(ReadArray, stepsOfAnySizeAndSign) {
    std::vector<double> cells;
    ElevationArray array = array_of(cells, ValueType::float64);
    std::swap(array.rows, array.cols);
    std::swap(array.values.row_step, array.values.col_step);
    EXPECT_EQ(values(array), (std::vector<double>{0, 10, 20, 1, 11, 21, 2, 12, 22, 3, 13, 23}));
    array = array_of(cells, ValueType::float64);
    array.rows = 2;
    array.cols = 2;
    array.values = {&cells[11], -2 * 4 * 8, -3 * 8};
    EXPECT_EQ(values(array), (std::vector<double>{23, 20, 3, 0}));
}

TEST_F(ReadArray, whatIsNotValid) {
    std::vector<float> cells;
    ElevationArray array = array_of(cells, ValueType::float32);
    std::array<std::uint8_t, 12> mask{};
    mask[1] = 1;
    array.masked = {mask.data(), 4, 1};
    cells[2] = std::numeric_limits<float>::infinity();
    cells[3] = static_cast<float>(invalid);
    cells[4] = -9999.9F;  // which is no -9999.9 as a double
    options_.nodata = -9999.9;
    EXPECT_EQ(values(array), (std::vector<double>{0, 99, 99, 99, 99, 11, 12, 13, 20, 21, 22, 23}));
}

TEST_F(ReadArray, aWindow) {
    std::vector<std::int16_t> cells;
    const ElevationArray array = array_of(cells, ValueType::int16);
    options_.source_window = {{1, 1, 2, 2}};
    EXPECT_EQ(values(array), (std::vector<double>{11, 12, 21, 22}));
    options_.source_window = {};
    options_.extent = {{500002, 5538689, 500004, 5538690}};
    EXPECT_EQ(values(array), (std::vector<double>{2, 3}));
}

TEST_F(ReadArray, whatIsKnownOfIt) {
    std::vector<std::uint8_t> cells;
    ElevationArray array = array_of(cells, ValueType::uint8);
    const DemInfo info = open_dem(array, options_, callbacks_)->info();
    EXPECT_TRUE(info.bytes);
    EXPECT_TRUE(info.georeferenced);
    EXPECT_EQ(info.transform, *array.transform);
    EXPECT_NE(info.crs_wkt.find("32632"), std::string::npos);
    EXPECT_TRUE(warnings_.empty());
    array.transform = {};
    options_.crs = "";
    EXPECT_EQ(open_dem(array, options_, callbacks_)->info().transform, DemInfo{}.transform);
    EXPECT_EQ(warnings_, (std::vector<std::string>{
                             "'array' has no georeferencing; coordinates are columns and, upwards, rows.",
                             "'array' has no coordinate reference system; lengths are taken as plain units; "
                             "give it with -a_srs."}));
}

TEST_F(ReadArray, refusals) {
    std::vector<double> cells;
    const ElevationArray array = array_of(cells, ValueType::float64);
    ElevationArray empty = array;
    empty.cols = 0;
    EXPECT_THROW(static_cast<void>(open_dem(empty, options_, callbacks_)), InputError);
    ElevationArray flat = array;
    flat.transform = {{0, 1, 1, 0, 1, 1}};
    EXPECT_THROW(static_cast<void>(open_dem(flat, options_, callbacks_)), InputError);
    std::array<ReadOptions, 3> of_files;
    of_files[0].band = 2;
    of_files[1].open_options = {"A=B"};
    of_files[2].drivers = {"GTiff"};
    for (const ReadOptions& options : of_files)
        EXPECT_THROW(static_cast<void>(open_dem(array, options, callbacks_)), OptionError);
}

/// Facts about a real DEM, found with NumPy from the bands as GDAL gives them.
struct City {
    const char* file;
    int cols;
    int rows;
    const char* unit;
    int valid;
    double minimum;
    double maximum;
    double sum;
    double at_100_100;
    const char* crs;
};

void PrintTo(const City& city, std::ostream* stream) {
    *stream << city.file;
}

class ReadCity : public ReadTest, public ::testing::WithParamInterface<City> {};

TEST_P(ReadCity, isReadWhole) {
    const City& city = GetParam();
    options_.source = std::string(D2B_SHARED) + "/cities/" + city.file;
    if (!std::filesystem::exists(options_.source))
        GTEST_SKIP() << "the real DEM " << options_.source << " is not here";
    const std::unique_ptr<DemSource> source = open();
    EXPECT_EQ(source->info().cols, city.cols);
    EXPECT_EQ(source->info().rows, city.rows);
    EXPECT_EQ(source->info().band_unit, city.unit);
    expect_has(source->info().crs_wkt, city.crs);
    const std::vector<double> elevations = read_all(*source);
    int valid = 0;
    double minimum = 1e9;
    double maximum = -1e9;
    double sum = 0;
    for (const double z : elevations)
        if (!std::isnan(z)) {
            ++valid;
            minimum = std::min(minimum, z);
            maximum = std::max(maximum, z);
            sum += z;
        }
    EXPECT_EQ(valid, city.valid);
    EXPECT_EQ(minimum, city.minimum);
    EXPECT_EQ(maximum, city.maximum);
    EXPECT_NEAR(sum, city.sum, 1e-9 * city.sum);
    EXPECT_EQ(elevations[static_cast<std::size_t>(100 * city.cols + 100)], city.at_100_100);
    EXPECT_TRUE(warnings_.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Cities, ReadCity,
    ::testing::Values(
        City{"delft/dsm.tif", 527, 456, "m", 224129, -0.5680000185966492, 26.32900047302246,
             1094635.1119940942, 0.2840000092983246, "PROJCRS[\"Amersfoort / RD New\""},
        City{"annarbor/dsm.tif", 786, 868, "m", 682248, 254.0, 300.3396301269531, 185497837.1700287, 280.0,
             "PROJCRS[\"NAD83 / Michigan South (ft)\""},
        City{"annarbor/dsm_zfeet.tif", 786, 868, "ft", 682248, 833.3333129882812, 985.3662109375,
             608588704.7709961, 918.6351928710938, "PROJCRS[\"NAD83 / Michigan South (ft)\""},
        City{"stuttgart_csite2/dsm.tif", 420, 632, "m", 263594, 283.6400146484375, 350.42999267578125,
             79954669.06994629, 294.739990234375, "PROJCRS[\"WGS 84 / UTM zone 32N\""},
        City{"stuttgart_csite2/derived_epsg4326_dsm.tif", 541, 537, "m", 286493, 284.5199890136719, 349.5,
             86900307.07919312, 290.2699890136719, "GEOGCRS[\"WGS 84\""}),
    [](const auto& test) { return case_name(test.param.file); });

}  // namespace
}  // namespace d2b::test

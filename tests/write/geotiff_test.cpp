#include "write/raster/geotiff.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {

namespace {

namespace fs = std::filesystem;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

class GeoTiffTest : public WriteTest {
  protected:
    GeoTiffTest() {
        grid_.name = "dem.tif";
        grid_.rows = 700;
        grid_.cols = 400;
        grid_.window = {10, 20, 600, 300};
        grid_.transform = {500000, 0.5, 0.25, 5538650, 0.125, -0.5};
        grid_.georeferenced = true;
        grid_.crs_wkt = wkt_of(25832);
        meta_.description = "height above ground";
        meta_.metadata = {{"source", "dem.tif"}};
    }
    std::unique_ptr<RasterSink> sink(const std::string& name, bool overwrite = false, Names in_use = {}) {
        return writing::open_geotiff_sink({path(name), overwrite, std::move(in_use)}, grid_, meta_);
    }
    [[nodiscard]] std::size_t size(int rows) const {
        return static_cast<std::size_t>(rows) * static_cast<std::size_t>(grid_.window.cols);
    }
    /// The value of every cell is another, so that one in the wrong place is seen; few compress.
    [[nodiscard]] std::vector<float> values() const {
        std::vector<float> numbers;
        for (std::size_t i = 0; i < size(grid_.window.rows); ++i)
            numbers.push_back(static_cast<float>(std::sin(static_cast<double>(i)) * 100));
        numbers[5] = nan;
        return numbers;
    }
    /// Rows of the window, counted from its first.
    [[nodiscard]] Window rows_of(int first, int rows) const {
        return {grid_.window.row + first, grid_.window.col, rows, grid_.window.cols};
    }
    /// Gives all rows, 7 at a time, and finishes.
    void write_all(RasterSink& to) {
        const std::vector<float> all = values();
        for (int row = 0; row < grid_.window.rows; row += 7) {
            const int rows = std::min(7, grid_.window.rows - row);
            to.write(rows_of(row, rows), std::span(all).subspan(size(row), size(rows)));
        }
        to.finish();
    }
    static Dataset open_raster(const std::string& name) {
        return Dataset(GDALOpenEx(name.c_str(), GDAL_OF_RASTER, nullptr, nullptr, nullptr));
    }
    static std::vector<float> read(const std::string& name) {
        const Dataset file = open_raster(name);
        const int cols = GDALGetRasterXSize(file.get());
        const int rows = GDALGetRasterYSize(file.get());
        std::vector<float> got(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows));
        EXPECT_EQ(GDALRasterIO(GDALGetRasterBand(file.get(), 1), GF_Read, 0, 0, cols, rows, got.data(), cols,
                               rows, GDT_Float32, 0, 0),
                  CE_None);
        return got;
    }
    template <typename E>
    std::string refused(const std::string& name, bool overwrite = false, const Names& in_use = {}) {
        return thrown<E>([&] { static_cast<void>(sink(name, overwrite, in_use)); });
    }

    DemInfo grid_;
    writing::RasterMetadata meta_;
};

TEST_F(GeoTiffTest, ValuesAndWhatIsSaidOfThem) {
    write_all(*sink("a.tif"));
    std::vector<float> expected = values();
    expected[5] = -9999;
    EXPECT_EQ(read(path("a.tif")), expected);
    const Dataset file = open_raster(path("a.tif"));
    const GDALRasterBandH band = GDALGetRasterBand(file.get(), 1);
    EXPECT_EQ(GDALGetRasterDataType(band), GDT_Float32);
    EXPECT_EQ(GDALGetRasterNoDataValue(band, nullptr), -9999);
    EXPECT_STREQ(GDALGetRasterUnitType(band), "metre");
    EXPECT_STREQ(GDALGetDescription(band), "height above ground");
    EXPECT_STREQ(GDALGetMetadataItem(file.get(), "source", nullptr), "dem.tif");
    EXPECT_STREQ(GDALGetMetadataItem(file.get(), "AREA_OR_POINT", nullptr), "Area");
    EXPECT_STREQ(GDALGetMetadataItem(file.get(), "COMPRESSION", "IMAGE_STRUCTURE"), "DEFLATE");
    EXPECT_STREQ(GDALGetMetadataItem(file.get(), "PREDICTOR", "IMAGE_STRUCTURE"), "3");
    int width = 0;
    int height = 0;
    GDALGetBlockSize(band, &width, &height);
    EXPECT_EQ(width, 256);
    EXPECT_EQ(height, 256);
    EXPECT_EQ(entries(), (Names{"a.tif"}));
    EXPECT_TRUE(warnings_.empty());
}

TEST_F(GeoTiffTest, ThePlaceOfTheWindow) {
    write_all(*sink("a.tif"));
    const Dataset file = open_raster(path("a.tif"));
    std::array<double, 6> g{};
    ASSERT_EQ(GDALGetGeoTransform(file.get(), g.data()), CE_None);
    // Column 20 and row 10: 500000 + 20 * 0.5 + 10 * 0.25 and 5538650 + 20 * 0.125 - 10 * 0.5.
    EXPECT_EQ(g, (std::array<double, 6>{500012.5, 0.5, 0.25, 5538647.5, 0.125, -0.5}));
    EXPECT_STREQ(OSRGetAuthorityCode(GDALGetSpatialRef(file.get()), nullptr), "25832");
}

TEST_F(GeoTiffTest, WithoutPlaceAndCrs) {
    grid_.georeferenced = false;
    grid_.crs_wkt = "";
    write_all(*sink("a.tif"));
    const Dataset file = open_raster(path("a.tif"));
    std::array<double, 6> g{};
    EXPECT_NE(GDALGetGeoTransform(file.get(), g.data()), CE_None);
    EXPECT_EQ(GDALGetSpatialRef(file.get()), nullptr);
}

/// The CRS of a raster, with its heights or without.
std::string name_of_crs(const std::string& path) {
    const Dataset file(GDALOpenEx(path.c_str(), GDAL_OF_RASTER, nullptr, nullptr, nullptr));
    return OSRGetName(GDALGetSpatialRef(file.get()));
}

TEST_F(GeoTiffTest, TheVerticalCrsStaysWhereItIsTrue) {
    grid_.crs_wkt = wkt_of("EPSG:25832+7837");
    write_all(*sink("height.tif"));
    EXPECT_EQ(name_of_crs(path("height.tif")), "ETRS89 / UTM zone 32N");
    meta_.elevations = true;
    write_all(*sink("ground.tif"));
    EXPECT_EQ(name_of_crs(path("ground.tif")), "ETRS89 / UTM zone 32N + DHHN2016 height");
    grid_.crs_wkt = wkt_of("EPSG:2229+6360");  // heights in US survey feet
    write_all(*sink("feet.tif"));
    EXPECT_EQ(name_of_crs(path("feet.tif")), "NAD83 / California zone 5 (ftUS)");
}

TEST_F(GeoTiffTest, WhatIsNotFiniteIsNoData) {
    grid_.window = {0, 0, 1, 3};
    const auto to = sink("a.tif");
    to->write(grid_.window, std::vector<float>{nan, std::numeric_limits<float>::infinity(), 2});
    to->finish();
    EXPECT_EQ(read(path("a.tif")), (std::vector<float>{-9999, -9999, 2}));
}

TEST_F(GeoTiffTest, WhatIsNotFinishedLeavesNothing) {
    {
        const auto to = sink("a.tif");
        EXPECT_TRUE(entries().empty());
        to->write(grid_.window, values());
    }
    EXPECT_TRUE(entries().empty());
    write_all(*sink("a.tif"));
    const std::string before = bytes("a.tif");
    sink("a.tif", true)->write(rows_of(0, 300), std::span<const float>(values()).first(size(300)));
    EXPECT_EQ(bytes("a.tif"), before);
    EXPECT_EQ(entries(), (Names{"a.tif"}));
}

TEST_F(GeoTiffTest, PartsInAnyOrder) {
    write_all(*sink("rows.tif"));
    const std::vector<float> all = values();
    // Units of 130 x 170 cells, the last ones smaller, from the last to the first.
    const auto to = sink("parts.tif");
    for (int row = 4 * 130; row >= 0; row -= 130)
        for (int col = 170; col >= 0; col -= 170) {
            const Window part{10 + row, 20 + col, std::min(130, 600 - row), std::min(170, 300 - col)};
            std::vector<float> cells;
            for (int r = row; r < row + part.rows; ++r) {
                const auto from = all.begin() + r * 300 + col;
                cells.insert(cells.end(), from, from + part.cols);
            }
            to->write(part, cells);
        }
    to->finish();
    EXPECT_EQ(read(path("parts.tif")), read(path("rows.tif")));
    EXPECT_EQ(bytes("parts.tif").size(), bytes("rows.tif").size());  // no tile was written twice
}

TEST_F(GeoTiffTest, CellsThatAreMissingOrTooMany) {
    const auto to = sink("a.tif");
    to->write(rows_of(0, 300), std::span<const float>(values()).first(size(300)));
    const std::string start = "Cannot write \"" + path("a.tif") + "\": ";
    const auto refused_part = [&](const Window& part, std::size_t given) {
        return thrown<OutputError>([&] { to->write(part, std::vector<float>(given)); });
    };
    EXPECT_EQ(refused_part(rows_of(300, 301), size(301)),
              start +
                  "90300 values were given for 301 rows from 310 on and 300 columns from 20 on, which are "
                  "not part of it.");
    for (const Window& part : {Window{9, 20, 1, 300}, Window{400, 19, 1, 300}, Window{400, 21, 1, 300}})
        EXPECT_EQ(refused_part(part, 300).find(start + "300 values were given for 1 rows from "), 0u);
    EXPECT_EQ(refused_part(rows_of(300, 2), 300), start +
                                                      "300 values were given for 2 rows from 310 on and 300 "
                                                      "columns from 20 on, which are not part of it.");
    EXPECT_EQ(refused_part(rows_of(0, 1), 300), start + "some of its cells were given twice.");
    EXPECT_EQ(thrown<OutputError>([&] { to->finish(); }),
              start + "90000 of its 180000 cells were not given.");
}

TEST_F(GeoTiffTest, OverwritingReplacesWhatBelongsToTheFile) {
    write_all(*sink("a.tif"));
    put("a.tif.aux.xml", "<PAMDataset><GeoTransform>1,2,3,4,5,6</GeoTransform></PAMDataset>");
    put("a.tif.keep", "mine");
    grid_.transform[0] = 600000;
    write_all(*sink("a.tif", true));
    EXPECT_EQ(entries(), (Names{"a.tif", "a.tif.keep"}));
    const Dataset file = open_raster(path("a.tif"));
    std::array<double, 6> g{};
    ASSERT_EQ(GDALGetGeoTransform(file.get(), g.data()), CE_None);
    EXPECT_EQ(g[0], 600012.5);
}

TEST_F(GeoTiffTest, OtherFilesAreNotReplaced) {
    put("a.tif", "letters to my aunt");
    EXPECT_EQ(refused<OptionError>("a.tif", true),
              quote + path("a.tif") + "\" exists and is not a dataset of format GTiff; remove it first.");
    put("b.tif.aux.xml", "<PAMDataset/>");
    EXPECT_EQ(refused<OptionError>("b.tif"), quote + path("b.tif.aux.xml") +
                                                 "\" would be read as a part of \"" + path("b.tif") +
                                                 "\"; remove that file first or choose another name.");
    fs::create_directory(path("c.tif"));
    EXPECT_EQ(refused<OptionError>("c.tif", true),
              quote + path("c.tif") + "\" is a folder, and GeoTIFF writes a file; choose another name.");
    fs::create_symlink("/dev/full", path("d.tif"));
    EXPECT_EQ(
        refused<OptionError>("d.tif", true),
        quote + path("d.tif") + "\" is not a regular file, and GeoTIFF writes a file; choose another name.");
}

TEST_F(GeoTiffTest, AFileThatChangesMeanwhileStays) {
    write_all(*sink("a.tif"));
    const auto to = sink("a.tif", true);
    put("a.tif", "changed");
    EXPECT_EQ(thrown<OutputError>([&] { write_all(*to); }),
              quote + path("a.tif") + "\" changed during this run and was left alone; run again.");
    EXPECT_EQ(bytes("a.tif"), "changed");
}

TEST_F(GeoTiffTest, NamesOfOtherFormats) {
    for (const char* name : {"a.asc", "a", "a.tif.gz", "tif"})
        EXPECT_EQ(refused<OptionError>(name),
                  "Rasters are written as GeoTIFF; give \"" + path(name) + "\" a name that ends in .tif.");
    write_all(*sink("a.TIFF"));
    EXPECT_EQ(entries(), (Names{"a.TIFF"}));
}

TEST_F(GeoTiffTest, FilesInUseAreRefused) {
    const std::string text =
        quote + path("a.tif") + "\" is already read or written by this run; choose another name.";
    EXPECT_EQ(refused<OptionError>("a.tif", false, {"", path("b.tif"), path("a.tif")}), text);
    fs::create_directory(path("x"));
    EXPECT_EQ(refused<OptionError>("a.tif", false, {path("x/../a.tif")}), text);
    write_all(*sink("a.tif", false, {path("b.tif"), "/vsistdin/", "PG:dbname=none"}));
    fs::create_hard_link(path("a.tif"), path("link.tif"));
    EXPECT_EQ(refused<OptionError>("a.tif", true, {path("link.tif")}), text);
    put("mosaic.vrt",
        "<VRTDataset rasterXSize=\"1\" rasterYSize=\"1\"><VRTRasterBand dataType=\"Float32\" band=\"1\">"
        "<SimpleSource><SourceFilename relativeToVRT=\"1\">a.tif</SourceFilename></SimpleSource>"
        "</VRTRasterBand></VRTDataset>");
    EXPECT_EQ(refused<OptionError>("a.tif", true, {path("mosaic.vrt")}), text);
}

TEST_F(GeoTiffTest, ALinkStaysALink) {
    fs::create_directory(path("there"));
    fs::create_symlink("there/real.tif", path("a.tif"));
    write_all(*sink("a.tif"));
    EXPECT_TRUE(fs::is_symlink(path("a.tif")));
    EXPECT_EQ(entries("there"), (Names{"real.tif"}));
}

TEST_F(GeoTiffTest, InVirtualFileSystems) {
    const std::string name = "/vsimem/geotiff_sink/a.tif";
    const auto to = [&](bool overwrite) {
        return writing::open_geotiff_sink({name, overwrite, {}}, grid_, meta_);
    };
    to(false)->write(grid_.window, values());
    EXPECT_EQ(VSIReadDir("/vsimem/geotiff_sink"), nullptr);
    write_all(*to(false));
    EXPECT_EQ(read(name).at(0), 0);
    EXPECT_EQ(thrown<OptionError>([&] { static_cast<void>(to(false)); }),
              quote + name + "\" exists; give another name, or -overwrite to replace it.");
    write_all(*to(true));
    char** files = VSIReadDir("/vsimem/geotiff_sink");
    EXPECT_EQ(CSLCount(files), 1);
    CSLDestroy(files);
    VSIRmdirRecursive("/vsimem/geotiff_sink");
}

TEST_F(GeoTiffTest, AFullDiskLeavesNothing) {
    write_all(*sink("whole.tif"));
    const auto whole = static_cast<rlim_t>(fs::file_size(path("whole.tif")));
    fs::remove(path("whole.tif"));
    for (const rlim_t limit : {rlim_t{0}, rlim_t{100}, whole / 2, whole - 1000, whole - 1}) {
        const pid_t child = ::fork();
        if (child == 0) {
            ::signal(SIGXFSZ, SIG_IGN);
            const rlimit room{limit, limit};
            ::setrlimit(RLIMIT_FSIZE, &room);
            int result = 1;
            try {
                write_all(*sink("a.tif"));
            } catch (const OutputError& error) {
                const std::string text = error.what();
                const bool told = text.starts_with("Cannot write \"" + path("a.tif") + "\": ");
                result = told && text.find("/.dem2buildings") == std::string::npos ? 0 : 2;
            }
            ::_exit(result);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << limit << " " << WEXITSTATUS(status);
        EXPECT_TRUE(entries().empty()) << limit;
    }
}

TEST_F(GeoTiffTest, ABrokenCrsIsAnError) {
    grid_.crs_wkt = "PROJCRS[nonsense";
    const std::string text = thrown<OutputError>([&] { write_all(*sink("a.tif")); });
    EXPECT_EQ(text.find("Cannot write \"" + path("a.tif") + "\": setting the CRS failed ("), 0u) << text;
    EXPECT_TRUE(entries().empty());
}

}  // namespace

}  // namespace d2b::test

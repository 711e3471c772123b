#include "read/raster_mosaic.hpp"

#include <atomic>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>

#include <cpl_vsi.h>
#include <gtest/gtest.h>

#include "core/executor.hpp"
#include "dem2buildings/open_sources.hpp"
#include "read/gdal_handles.hpp"
#include "read/rasters.hpp"
#include "read/shared_raster.hpp"
#include "read/source_files.hpp"
#include "read/source_place.hpp"
#include "support/error_of.hpp"

namespace d2b::test {
namespace {

class ReadMosaic : public ReadTest {
  protected:
    /// Cells of the rasters, and those that none of them covers.
    std::vector<double> mosaic(const std::vector<std::string>& names) {
        std::vector<std::string> rasters;
        for (const std::string& name : names)
            rasters.push_back(path(name));
        reading::build_mosaic(path("source.vrt"), rasters, 1);
        return values("source.vrt");
    }
    std::string refusal(const std::vector<std::string>& names) {
        return error_of<InputError>([&] { (void)mosaic(names); });
    }
    static RasterSpec at(double x, double y, const std::vector<double>& values) {
        return {.cols = 2, .rows = 1, .values = values, .transform = {{x, 1, 0, y, 0, -1}}};
    }
};

TEST_F(ReadMosaic, putsRastersWhereTheyLie) {
    write(path("a.tif"), at(10, 20, {1, 2}));
    write(path("b.tif"), at(12, 19, {3, 4}));
    expect_values(mosaic({"a.tif", "b.tif"}), {1, 2, none, none, none, none, 3, 4});
    write(path("b.tif"), at(11, 20, {3, 4}));  // the later one is above the earlier
    expect_values(mosaic({"a.tif", "b.tif"}), {1, 3, 4});
    expect_values(mosaic({"b.tif", "a.tif"}), {1, 2, 4});
}

TEST_F(ReadMosaic, knowsNoDataInEach) {
    RasterSpec a = at(10, 20, {0, -7});
    RasterSpec b = at(12, 19, {-9, 4});
    write(path("a.tif"), a);
    b.nodata = -9;
    write(path("b.tif"), b);
    expect_values(mosaic({"a.tif", "b.tif"}), {0, -7, none, none, none, none, none, 4});
    a.nodata = -7;
    write(path("a.tif"), a);
    expect_values(mosaic({"a.tif", "b.tif"}), {0, none, none, none, none, none, none, 4});
}

TEST_F(ReadMosaic, ofBytesLeavesGapsWithoutData) {
    RasterSpec a = at(10, 20, {0, 254});
    RasterSpec b = at(12, 20, {255, 1});
    a.type = b.type = GDT_Byte;
    write(path("a.tif"), a);
    write(path("b.tif"), b);
    expect_values(mosaic({"a.tif", "b.tif"}), {0, 254, 255, 1});  // no gap: all are elevations
    b = at(13, 20, {2, 1});
    b.type = GDT_Byte;
    write(path("b.tif"), b);
    expect_values(mosaic({"a.tif", "b.tif"}), {0, 254, none, 2, 1});
}

/// Rows are copied where no raster lies above another one and all mean the same by no data.
TEST_F(ReadMosaic, looksAtEachCellOnlyWhereItHasTo) {
    const auto copies = [&] { return read_bytes(path("source.vrt")).find("<NODATA>") == std::string::npos; };
    RasterSpec a = at(10, 20, {1, -7});
    RasterSpec b = at(12, 20, {-7, 4});
    a.type = b.type = GDT_Float32;
    a.nodata = b.nodata = -7;
    write(path("a.tif"), a);
    write(path("b.tif"), b);
    expect_values(mosaic({"a.tif", "b.tif"}), {1, none, none, 4});
    EXPECT_TRUE(copies());
    b.nodata = -9;
    write(path("b.tif"), b);
    expect_values(mosaic({"a.tif", "b.tif"}), {1, none, none, 4});  // -7 is none of the mosaic's
    EXPECT_FALSE(copies());
    b = at(11, 20, {-7, 4});
    b.type = GDT_Float32;
    b.nodata = -7;
    write(path("b.tif"), b);
    write(path("c.tif"), a);
    expect_values(mosaic({"a.tif", "b.tif"}), {1, none, 4});
    expect_values(mosaic({"c.tif", "b.tif", "a.tif"}), {1, none, 4});
    EXPECT_FALSE(copies());
    a = at(10, 20, {3, 5});  // all of which is above
    a.type = GDT_Float32;
    a.nodata = -7;
    write(path("a.tif"), a);
    expect_values(mosaic({"a.tif", "b.tif"}), {3, 5, 4});
    EXPECT_FALSE(copies());
}

TEST_F(ReadMosaic, refusesWhatIsNotOnOneGrid) {
    write(path("a.tif"), at(10, 20, {1, 2}));
    const auto expect = [&](const RasterSpec& spec, const std::string& why, const std::string& advice) {
        write(path("b.tif"), spec);
        EXPECT_EQ(refusal({"a.tif", "b.tif"}),
                  "'" + path("b.tif") + "' cannot be a part of a mosaic: " + why + "; " + advice +
                      ", leave it out, or join the rasters with gdalbuildvrt and give its mosaic.");
    };
    const std::string first = "'" + path("a.tif") + "'";
    const std::string warp = "bring it onto that grid with gdalwarp";
    RasterSpec b = at(12.5, 20, {1, 2});
    expect(b, "its cells lie between those of " + first, warp);
    expect(at(12, 20.25, {1, 2}), "its cells lie between those of " + first, warp);
    b = at(12, 20, {1, 2});
    b.crs = "EPSG:25833";
    expect(b, "it has another coordinate reference system than " + first, warp);
    b.crs = "";
    expect(b, "it has another coordinate reference system than " + first, warp);
    b = at(12, 20, {1, 2});
    b.transform = {{12, 1.01, 0, 20, 0, -1}};
    expect(b, "it has cells of another size than " + first, warp);
    b.transform = {{12, 1, 0.1, 20, 0, -1}};
    expect(b, "it is rotated or upside down", "bring it onto the grid of the others with gdalwarp");
    b.transform = {};
    expect(b, "it has no georeferencing", "give it corners with gdal_translate -a_ullr");
    b = at(12, 20, {1, 2});
    b.type = GDT_Int16;
    expect(b, "it holds Int16, not Float64 as " + first, "give it that type with gdal_translate -ot");
    GDALDatasetH feet = create(path("b.tif"), at(12, 20, {1, 2}));
    GDALSetRasterUnitType(GDALGetRasterBand(feet, 1), "ft");
    GDALClose(feet);
    EXPECT_EQ(refusal({"a.tif", "b.tif"}),
              "'" + path("b.tif") +
                  "' cannot be a part of a mosaic: it says that its unit is 'ft', not '' as " + first +
                  "; set the right one with gdal_edit.py -units, leave it out, or join the rasters with "
                  "gdalbuildvrt and give its mosaic.");
    expect_has(refusal({"a.tif", "c.tif"}), "'" + path("c.tif") + "' cannot be opened as a raster: ");
}

TEST_F(ReadMosaic, refusesWhatGdalLeavesOut) {
    write(path("a.tif"), at(10, 20, {1, 2}));
    RasterSpec b = at(12, 20, {1, 2});
    b.bands = 2;
    write(path("b.tif"), b);
    expect_has(refusal({"a.tif", "b.tif"}), "The rasters cannot be made into a mosaic: ");
}

TEST_F(ReadMosaic, isWrittenOrNot) {
    write(path("a.tif"), at(10, 20, {1, 2}));
    try {
        reading::build_mosaic("/nowhere/source.vrt", {path("a.tif")}, 1);
        ADD_FAILURE();
    } catch (const OutputError& error) {
        expect_has(error.what(), "'/nowhere/source.vrt' cannot be written: ");
    }
}

class ReadSeveral : public ReadTest {
  protected:
    void SetUp() override {
        ReadTest::SetUp();
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
        west_ = strip(10, {1, 2});
        east_ = strip(12, {3, 4});
        std::filesystem::create_directory(path("tiles"));
        write(path("tiles/b.tif"), west_);
        write(path("tiles/a.tif"), east_);
    }
    void TearDown() override {
        std::filesystem::remove_all(folder_);
        ReadTest::TearDown();
    }
    /// A folder on disk, because those in memory are not looked into.
    [[nodiscard]] std::string path(const std::string& name) const { return folder_ + name; }
    static RasterSpec strip(double x, const std::vector<double>& values) {
        return {.cols = 2, .rows = 1, .values = values, .transform = {{x, 1, 0, 20, 0, -1}}};
    }
    std::string refusal() {
        return error_of<Error>([&] { (void)open(); });
    }
    std::string folder_ = testing::TempDir() + "d2b_several_" +
                          testing::UnitTest::GetInstance()->current_test_info()->name() + "/";
    RasterSpec west_;
    RasterSpec east_;
};

TEST_F(ReadSeveral, namesOnePerLine) {
    options_.source = path("tiles/b.tif") + "\n" + path("tiles/a.tif");
    expect_values(values(), {1, 2, 3, 4});
    EXPECT_EQ(open()->info().name, path("tiles/b.tif") + " and 1 other");
    EXPECT_EQ(open()->info().driver, "VRT");
    write(path("tiles/a.tif"), strip(11, {7, 8}));
    expect_values(values(), {1, 7, 8});  // the later one lies above
    options_.source += "\n" + path("tiles/b.tif");
    expect_values(values(), {1, 2, 8});
    EXPECT_EQ(open()->info().name, path("tiles/b.tif") + " and 2 others");
}

TEST_F(ReadSeveral, aFolder) {
    options_.source = path("tiles");
    // Neither a text, an overview, a database of polygons nor a mosaic of the same rasters is one of them.
    write_text(path("tiles/readme.txt"), "tiles\n");
    write(path("tiles/a.tif.ovr"), strip(10, {9, 9}));
    write(path("tiles/all.vrt"),
          {.cols = 2, .rows = 1, .transform = {{50, 1, 0, 20, 0, -1}}, .driver = "VRT"});
    expect_values(values(), {1, 2, 3, 4});
    EXPECT_EQ(open()->info().name, path("tiles"));
    EXPECT_EQ(reading::rasters_of(path("tiles")), (std::vector{path("tiles/a.tif"), path("tiles/b.tif")}));
    EXPECT_EQ(reading::rasters_of(path("tiles") + "/"),
              (std::vector{path("tiles/a.tif"), path("tiles/b.tif")}));
    EXPECT_TRUE(reading::rasters_of(path("tiles/a.tif")).empty());
    std::filesystem::remove(path("tiles/a.tif"));
    expect_values(values(), {1, 2});
}

/// A run may have written its rasters and a picture there.
TEST_F(ReadSeveral, aFolderWithoutResults) {
    write(path("tiles/height.tif"), strip(10, {0, 0}));
    const reading::DatasetOwner raster(GDALOpenEx(
        path("tiles/height.tif").c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE, nullptr, nullptr, nullptr));
    GDALSetMetadataItem(raster.get(), "D2B_VERSION", "0.1.0", nullptr);
    GDALFlushCache(raster.get());
    write(path("map.tif"), {.cols = 2, .rows = 2, .type = GDT_Byte, .values = {1, 2, 3, 4}});
    const reading::DatasetOwner map(
        GDALOpenEx(path("map.tif").c_str(), GDAL_OF_RASTER, nullptr, nullptr, nullptr));
    const reading::DatasetOwner picture(GDALCreateCopy(GDALGetDriverByName("PNG"),
                                                       path("tiles/map.png").c_str(), map.get(), FALSE,
                                                       nullptr, nullptr, nullptr));
    options_.source = path("tiles");
    EXPECT_EQ(reading::rasters_of(path("tiles")), (std::vector{path("tiles/a.tif"), path("tiles/b.tif")}));
    expect_values(values(), {1, 2, 3, 4});
}

TEST_F(ReadSeveral, refusesATruncatedRasterOfAFolder) {
    write_text(path("tiles/c.tif"), "");
    options_.source = path("tiles");
    expect_has(refusal(), "'" + path("tiles/c.tif") + "' cannot be opened as a raster: ");
}

TEST_F(ReadSeveral, refusesWhatIsNoMosaic) {
    std::filesystem::create_directory(path("empty"));
    options_.source = path("empty");
    EXPECT_EQ(refusal(), "The folder '" + path("empty") +
                             "' holds no raster that GDAL reads; give a raster, several, or another folder.");
    options_.source = path("tiles");
    options_.drivers = {"GTiff"};
    EXPECT_EQ(
        refusal(),
        "-if applies to one raster, and the source is several; join them with gdalbuildvrt and give its "
        "mosaic.");
    options_.drivers.clear();
    options_.open_options = {"A=B"};
    EXPECT_EQ(
        refusal(),
        "-oo applies to one raster, and the source is several; join them with gdalbuildvrt and give its "
        "mosaic.");
    options_.open_options.clear();
    options_.source = path("tiles/a.tif") + "\n/vsistdin/";
    EXPECT_EQ(refusal(),
              "'/vsistdin/' cannot be one of several sources, because it can be read only once; give files.");
    write(path("tiles/c.tif"), strip(14.5, {1, 2}));
    options_.source = path("tiles");
    EXPECT_EQ(refusal(),
              "'" + path("tiles/c.tif") +
                  "' cannot be a part of a mosaic: its cells lie between "
                  "those of '" +
                  path("tiles/a.tif") +
                  "'; bring it onto that grid with gdalwarp, leave it out, or join the rasters with "
                  "gdalbuildvrt and give its mosaic.");
}

TEST_F(ReadSeveral, filesThatAreReadAreThoseOfTheRasters) {
    options_.source = path("tiles");
    const std::vector<reading::SourceFile> files = reading::source_files(options_);
    ASSERT_EQ(files.size(), 2U);
    EXPECT_EQ(files[0].name, path("tiles/a.tif"));
    EXPECT_EQ(files[1].name, path("tiles/b.tif"));
}

TEST(ReadList, hasANameALine) {
    const std::string list = testing::TempDir() + "d2b_raster_list.txt";
    const auto read = [&](const std::string& text) {
        std::ofstream(list, std::ios::binary) << text;
        return reading::read_raster_list(list);
    };
    EXPECT_EQ(read("a.tif\r\n\n two words.tif \n/vsizip/b.zip/b.tif"),
              (std::vector<std::string>{"a.tif", " two words.tif", "/vsizip/b.zip/b.tif"}));
    for (const std::string nothing : {"", "\n \n"})
        EXPECT_EQ(error_of<InputError>([&] { (void)read(nothing); }),
                  "'" + list + "' names no raster; write one raster name per line.");
    std::remove(list.c_str());
    for (const auto& [name, why] :
         {std::pair{list, "No such file or directory"}, std::pair{testing::TempDir(), "Is a directory"}})
        EXPECT_EQ(
            error_of<InputError>([&file = name] { (void)reading::read_raster_list(file); }),
            "'" + name + "' cannot be read: " + why + "; give a text file with one raster name per line.");
}

}  // namespace
}  // namespace d2b::test

namespace d2b::test {
namespace {

using Ends = std::vector<std::int32_t>;

constexpr reading::ColumnLimits narrow{3, 4, 1000};

TEST(MosaicColumns, EndWhereNoRasterIsCut) {
    EXPECT_EQ(reading::divide_columns({{0, 5}, {5, 10}, {10, 15}}, 15, narrow), (Ends{5, 10, 15}));
    EXPECT_EQ(reading::divide_columns({{10, 15}, {0, 6}, {5, 10}}, 15, narrow),
              (Ends{10, 15}));                                                               // two overlap
    EXPECT_EQ(reading::divide_columns({{0, 5}, {5, 10}, {4, 12}}, 15, narrow), (Ends{15}));  // another row
    EXPECT_EQ(reading::divide_columns({{0, 20}, {5, 10}, {10, 15}}, 20, narrow),
              (Ends{20}));                                                             // below all of them
    EXPECT_EQ(reading::divide_columns({{2, 5}, {8, 15}}, 15, narrow), (Ends{8, 15}));  // a gap
    EXPECT_EQ(reading::divide_columns({}, 15, narrow), (Ends{15}));
}

TEST(MosaicColumns, AreNeitherNarrowNorMany) {
    std::vector<reading::ColumnSpan> rasters;
    for (std::int32_t col = 0; col < 24; col += 2)
        rasters.push_back({col, col + 2});
    EXPECT_EQ(reading::divide_columns(rasters, 24, {3, 100, 10000}), (Ends{4, 8, 12, 16, 20, 24}));
    EXPECT_EQ(reading::divide_columns(rasters, 24, {1, 3, 10000}), (Ends{8, 16, 24}));
    EXPECT_EQ(reading::divide_columns(rasters, 24, {1, 100, 26}), (Ends{12, 24}));  // 13 and 13 rasters
    EXPECT_EQ(reading::divide_columns(rasters, 24, {1, 100, 12}), (Ends{24}));
}

/// Three rasters side by side and two below them, wide enough to be read apart.
class ReadColumns : public ReadTest {
  protected:
    static double value(std::int32_t row, std::int32_t col) { return row * 10000.0 + col; }

    void SetUp() override {
        ReadTest::SetUp();
        std::vector<std::string> names;
        for (const Window& part :
             {Window{0, 0, 10, 2200}, Window{0, 2200, 10, 2400}, Window{0, 4600, 10, 2400},
              Window{10, 0, 14, 4600}, Window{10, 4600, 14, 2400}}) {
            RasterSpec spec;
            spec.cols = part.cols;
            spec.rows = part.rows;
            spec.type = GDT_Float64;
            spec.transform = {{static_cast<double>(part.col), 1, 0, -static_cast<double>(part.row), 0, -1}};
            for (std::int32_t row = part.row; row < part.end_row(); ++row)
                for (std::int32_t col = part.col; col < part.end_col(); ++col)
                    spec.values.push_back(value(row, col));
            names.push_back(path("part_" + std::to_string(names.size()) + ".tif"));
            write(names.back(), spec);
        }
        reading::build_mosaic(path("all.vrt"), names, 1);
    }
    /// How many cells of many windows, read by four threads, are not as they should be.
    int wrong_cells(DemSource& source) {
        std::atomic<int> wrong = 0;
        Executor(4).for_each(200, [&](std::size_t k) {
            const auto i = static_cast<std::int32_t>(k);
            const Window part{i * 7 % 20, i * 613 % 5000, 1 + i % 4, 1 + i * 877 % 2000};
            std::vector<double> elevations(static_cast<std::size_t>(part.points()));
            source.read(part, elevations);
            for (std::int32_t row = 0; row < part.rows; ++row)
                for (std::int32_t col = 0; col < part.cols; ++col)
                    wrong += elevations[static_cast<std::size_t>(row * part.cols + col)] ==
                                     value(part.row + row, part.col + col)
                                 ? 0
                                 : 1;
        });
        return wrong;
    }
};

TEST_F(ReadColumns, GiveEachThreadItsCells) {
    const reading::DatasetOwner mosaic(GDALOpen(path("all.vrt").c_str(), GA_ReadOnly));
    ASSERT_NE(mosaic, nullptr);
    EXPECT_EQ(reading::ends_of_columns(mosaic.get(), 1), (Ends{4600, 7000}));
    const std::unique_ptr<DemSource> source = open("all.vrt");
    EXPECT_EQ(wrong_cells(*source), 0);
    EXPECT_TRUE(warnings_.empty());
}

/// Each column has a handle of its own on rasters that are in several.
TEST_F(ReadColumns, MayHaveTheSameRaster) {
    constexpr std::int32_t width = 2200;
    constexpr std::int32_t height = 10;
    std::string sources;
    for (std::int32_t col = 0; col < 3 * width; col += width)
        sources +=
            "<SimpleSource><SourceFilename relativeToVRT=\"1\">part_0.tif</SourceFilename>"
            "<SourceBand>1</SourceBand><SourceProperties RasterXSize=\"2200\" RasterYSize=\"10\" "
            "DataType=\"Float64\" "
            "BlockXSize=\"2200\" BlockYSize=\"1\"/><SrcRect xOff=\"0\" yOff=\"0\" xSize=\"2200\" "
            "ySize=\"10\"/>"
            "<DstRect xOff=\"" +
            std::to_string(col) + "\" yOff=\"0\" xSize=\"2200\" ySize=\"10\"/></SimpleSource>";
    write_text(path("same.vrt"),
               "<VRTDataset rasterXSize=\"6600\" rasterYSize=\"10\"><SRS>EPSG:25832</SRS>"
               "<GeoTransform>0,1,0,0,0,-1</GeoTransform><VRTRasterBand dataType=\"Float64\" band=\"1\">" +
                   sources + "</VRTRasterBand></VRTDataset>");
    const reading::DatasetOwner mosaic(GDALOpen(path("same.vrt").c_str(), GA_ReadOnly));
    ASSERT_NE(mosaic, nullptr);
    EXPECT_EQ(reading::ends_of_columns(mosaic.get(), 1), (Ends{width, 2 * width, 3 * width}));
    const std::unique_ptr<DemSource> source = open("same.vrt");
    std::atomic<int> wrong = 0;
    Executor(4).for_each(300, [&](std::size_t k) {
        const auto row = static_cast<std::int32_t>(k % height);
        std::vector<double> elevations(static_cast<std::size_t>(3 * width));
        source->read({row, 0, 1, 3 * width}, elevations);
        for (std::int32_t col = 0; col < 3 * width; ++col)
            wrong += elevations[static_cast<std::size_t>(col)] == value(row, col % width) ? 0 : 1;
    });
    EXPECT_EQ(wrong, 0);
}

TEST_F(ReadColumns, AreReadByOneWhereTheMosaicIsGone) {
    const std::unique_ptr<DemSource> source = open("all.vrt");
    ASSERT_EQ(VSIUnlink(path("all.vrt").c_str()), 0);
    EXPECT_EQ(wrong_cells(*source), 0);
}

TEST_F(ReadColumns, AreNotThoseOfAnotherRaster) {
    const reading::DatasetOwner raster(GDALOpen(path("part_0.tif").c_str(), GA_ReadOnly));
    ASSERT_NE(raster, nullptr);
    EXPECT_EQ(reading::ends_of_columns(raster.get(), 1), (Ends{2200}));
    const reading::DatasetOwner mosaic(GDALOpen(path("all.vrt").c_str(), GA_ReadOnly));
    EXPECT_EQ(reading::ends_of_columns(mosaic.get(), 2), (Ends{7000}));
}

TEST(CellBoxes, ThatShareCellsAreNotApart) {
    EXPECT_TRUE(reading::are_disjoint({}));
    EXPECT_TRUE(reading::are_disjoint({{{{0, 5}, {0, 5}}}}));
    EXPECT_TRUE(reading::are_disjoint(
        {{{{0, 5}, {0, 5}}}, {{{5, 9}, {0, 5}}}, {{{-4, 9}, {5, 6}}}, {{{0, 9}, {-3, 0}}}}));
    EXPECT_FALSE(reading::are_disjoint({{{{0, 5}, {0, 5}}}, {{{0, 5}, {0, 5}}}}));
    EXPECT_FALSE(reading::are_disjoint({{{{0, 9}, {0, 9}}}, {{{3, 4}, {3, 4}}}}));   // one within the other
    EXPECT_FALSE(reading::are_disjoint({{{{3, 4}, {0, 9}}}, {{{0, 9}, {3, 4}}}}));   // a cross
    EXPECT_FALSE(reading::are_disjoint({{{{0, 5}, {0, 5}}}, {{{4, 9}, {-3, 1}}}}));  // a corner
}

TEST(CellBoxes, AreApartAsEveryTwoAre) {
    std::mt19937 random(7);
    const auto pick = [&](int most) {
        return static_cast<double>(std::uniform_int_distribution(0, most)(random));
    };
    const auto meet = [](const reading::RasterBox& a, const reading::RasterBox& b) {
        return a[0][0] < b[0][1] && b[0][0] < a[0][1] && a[1][0] < b[1][1] && b[1][0] < a[1][1];
    };
    int apart = 0;
    for (int round = 0; round < 2000; ++round) {
        std::vector<reading::RasterBox> boxes;
        bool expected = true;
        for (int i = 0; i < 6; ++i) {
            const std::array<double, 2> at{pick(11), pick(11)};
            const reading::RasterBox box{{{at[0], at[0] + 1 + pick(3)}, {at[1], at[1] + 1 + pick(3)}}};
            for (const reading::RasterBox& other : boxes)
                expected = expected && !meet(box, other);
            boxes.push_back(box);
        }
        apart += expected ? 1 : 0;
        EXPECT_EQ(reading::are_disjoint(boxes), expected);
    }
    EXPECT_GT(apart, 100);
    EXPECT_LT(apart, 1900);
}

}  // namespace
}  // namespace d2b::test

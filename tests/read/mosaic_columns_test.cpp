#include <atomic>
#include <memory>

#include <cpl_vsi.h>
#include <gtest/gtest.h>

#include "core/executor.hpp"
#include "dem2buildings/open_sources.hpp"
#include "read/gdal_handles.hpp"
#include "read/raster_mosaic.hpp"
#include "read/rasters.hpp"
#include "read/shared_raster.hpp"

namespace d2b {
namespace {

using namespace test;
using Ends = std::vector<std::int32_t>;

constexpr ColumnLimits narrow{3, 4, 1000};

TEST(MosaicColumns, EndWhereNoRasterIsCut) {
    EXPECT_EQ(divide_columns({{0, 5}, {5, 10}, {10, 15}}, 15, narrow), (Ends{5, 10, 15}));
    EXPECT_EQ(divide_columns({{10, 15}, {0, 6}, {5, 10}}, 15, narrow), (Ends{10, 15}));  // two overlap
    EXPECT_EQ(divide_columns({{0, 5}, {5, 10}, {4, 12}}, 15, narrow), (Ends{15}));       // another row
    EXPECT_EQ(divide_columns({{0, 20}, {5, 10}, {10, 15}}, 20, narrow), (Ends{20}));     // below all of them
    EXPECT_EQ(divide_columns({{2, 5}, {8, 15}}, 15, narrow), (Ends{8, 15}));             // a gap
    EXPECT_EQ(divide_columns({}, 15, narrow), (Ends{15}));
}

TEST(MosaicColumns, AreNeitherNarrowNorMany) {
    std::vector<ColumnSpan> rasters;
    for (std::int32_t col = 0; col < 24; col += 2)
        rasters.push_back({col, col + 2});
    EXPECT_EQ(divide_columns(rasters, 24, {3, 100, 10000}), (Ends{4, 8, 12, 16, 20, 24}));
    EXPECT_EQ(divide_columns(rasters, 24, {1, 3, 10000}), (Ends{8, 16, 24}));
    EXPECT_EQ(divide_columns(rasters, 24, {1, 100, 26}), (Ends{12, 24}));  // 13 and 13 rasters
    EXPECT_EQ(divide_columns(rasters, 24, {1, 100, 12}), (Ends{24}));
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
        build_mosaic(path("all.vrt"), names, 1);
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
    const DatasetOwner mosaic(GDALOpen(path("all.vrt").c_str(), GA_ReadOnly));
    ASSERT_NE(mosaic, nullptr);
    EXPECT_EQ(ends_of_columns(mosaic.get(), 1), (Ends{4600, 7000}));
    const std::unique_ptr<DemSource> source = open("all.vrt");
    EXPECT_EQ(wrong_cells(*source), 0);
    EXPECT_TRUE(warnings_.empty());
}

/// Each column has a handle of its own on what is in several.
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
    const DatasetOwner mosaic(GDALOpen(path("same.vrt").c_str(), GA_ReadOnly));
    ASSERT_NE(mosaic, nullptr);
    EXPECT_EQ(ends_of_columns(mosaic.get(), 1), (Ends{width, 2 * width, 3 * width}));
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
    const DatasetOwner raster(GDALOpen(path("part_0.tif").c_str(), GA_ReadOnly));
    ASSERT_NE(raster, nullptr);
    EXPECT_EQ(ends_of_columns(raster.get(), 1), (Ends{2200}));
    const DatasetOwner mosaic(GDALOpen(path("all.vrt").c_str(), GA_ReadOnly));
    EXPECT_EQ(ends_of_columns(mosaic.get(), 2), (Ends{7000}));
}

}  // namespace
}  // namespace d2b

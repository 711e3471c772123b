#include <atomic>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/executor.hpp"
#include "dem2buildings/open_sources.hpp"
#include "read/band_reader.hpp"
#include "read/rasters.hpp"

namespace d2b::test {
namespace {

using Stretches = std::vector<std::pair<std::int32_t, std::int32_t>>;

Stretches added(reading::RowCoverage& seen, std::int32_t row, std::int32_t begin, std::int32_t end) {
    Stretches some;
    seen.add(row, begin, end, [&](std::int32_t from, std::int32_t to) { some.emplace_back(from, to); });
    return some;
}

TEST(RowCoverage, AreNewOnce) {
    reading::RowCoverage seen(3);
    EXPECT_EQ(added(seen, 1, 10, 20), (Stretches{{10, 20}}));
    EXPECT_EQ(added(seen, 1, 10, 20), Stretches{});
    EXPECT_EQ(added(seen, 2, 10, 20), (Stretches{{10, 20}}));
    EXPECT_EQ(added(seen, 1, 30, 40), (Stretches{{30, 40}}));
    EXPECT_EQ(added(seen, 1, 5, 45), (Stretches{{5, 10}, {20, 30}, {40, 45}}));
    EXPECT_EQ(added(seen, 1, 0, 50), (Stretches{{0, 5}, {45, 50}}));
    EXPECT_EQ(added(seen, 1, 50, 50), Stretches{});
    EXPECT_EQ(added(seen, 0, 3, 4), (Stretches{{3, 4}}));
}

TEST(RowCoverage, InAnyOrderEachCellIsNewOnce) {
    std::mt19937 random(3);
    reading::RowCoverage seen(1);
    std::vector<bool> cells(200);
    for (int k = 0; k < 2000; ++k) {
        const auto begin = static_cast<std::int32_t>(random() % 200);
        const auto end = begin + static_cast<std::int32_t>(random() % 9);
        std::vector<bool> is_new(220);
        for (const auto& [from, to] : added(seen, 0, begin, std::min(end, 200)))
            for (std::int32_t i = from; i < to; ++i)
                is_new[static_cast<std::size_t>(i)] = true;
        for (std::size_t i = 0; i < 200; ++i) {
            const bool asked = static_cast<std::int32_t>(i) >= begin && static_cast<std::int32_t>(i) < end;
            ASSERT_EQ(is_new[i], asked && !cells[i]) << k << " " << i;
            cells[i] = cells[i] || asked;
        }
    }
}

class ReaderPools : public ReadTest, public testing::WithParamInterface<const char*> {};

TEST_P(ReaderPools, GiveEachThreadItsRows) {
    constexpr int cols = 300;
    constexpr int rows = 400;
    constexpr int band = 10;
    RasterSpec spec;
    spec.cols = cols;
    spec.rows = rows;
    spec.type = GDT_Float32;
    spec.values = counting(cols * rows);
    spec.driver = GetParam();
    if (spec.driver == "GTiff")
        spec.creation = {"TILED=YES", "COMPRESS=DEFLATE"};
    write(path("dem"), spec);
    const std::unique_ptr<DemSource> source = open("dem");
    std::atomic<int> wrong = 0;
    Executor(4).for_each(200, [&](std::size_t k) {
        const auto row = static_cast<std::int32_t>(k * 37 % (rows - band));
        std::vector<double> elevations(cols * band);
        source->read(whole_rows(*source, row, band), elevations);
        for (std::size_t i = 0; i < elevations.size(); ++i)
            wrong += elevations[i] == static_cast<double>(row * cols) + static_cast<double>(i) ? 0 : 1;
    });
    EXPECT_EQ(wrong, 0);
    EXPECT_TRUE(warnings_.empty());
}

INSTANTIATE_TEST_SUITE_P(, ReaderPools, testing::Values("GTiff", "ENVI"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace d2b::test

namespace d2b::test {
namespace {

using Texts = std::vector<std::string>;

/// A mosaic opens its files when they are read, and GDAL warns of an option that such a file does not have.
TEST_F(ReadTest, WhatReadingShowsWaitsForWhoAsks) {
    write(path("part.tif"), {.cols = 2, .rows = 2, .values = {1, 2, 3, 4}});
    write_text(path("dem.vrt"), R"(<VRTDataset rasterXSize="2" rasterYSize="2"><SRS>EPSG:25832</SRS>
<GeoTransform>0, 1, 0, 0, 0, -1</GeoTransform>
<VRTRasterBand dataType="Float64" band="1"><SimpleSource>
<SourceFilename relativeToVRT="1">part.tif</SourceFilename><OpenOptions><OOI key="NO_SUCH">1</OOI></OpenOptions>
<SourceBand>1</SourceBand><SourceProperties RasterXSize="2" RasterYSize="2" DataType="Float64" BlockXSize="2" BlockYSize="2"/>
<SrcRect xOff="0" yOff="0" xSize="2" ySize="2"/><DstRect xOff="0" yOff="0" xSize="2" ySize="2"/>
</SimpleSource></VRTRasterBand></VRTDataset>)");
    const auto source = open("dem.vrt");
    EXPECT_EQ(warnings_, Texts{});
    std::vector<double> elevations;
    std::thread([&] { elevations = read_all(*source); }).join();
    expect_values(elevations, {1, 2, 3, 4});
    EXPECT_EQ(warnings_, Texts{});
    EXPECT_EQ(source->take_warnings(), Texts{"GDAL: driver GTiff does not support open option NO_SUCH."});
    (void)read_all(*source);
    EXPECT_EQ(source->take_warnings(), Texts{});
}

}  // namespace
}  // namespace d2b::test

#include <algorithm>
#include <limits>

#include <cpl_vsi.h>

#include "dem2buildings/open_sources.hpp"
#include "read/rasters.hpp"

namespace d2b::test {
namespace {

struct TypeCase {
    GDALDataType type;
    std::vector<double> values;
};

class ReadTypes : public ReadTest, public ::testing::WithParamInterface<TypeCase> {};

TEST_P(ReadTypes, valuesComeBackAsDoubles) {
    write("/vsimem/typed.tif", {.cols = 2, .rows = 1, .type = GetParam().type, .values = GetParam().values});
    options_.source = "/vsimem/typed.tif";
    expect_values(values(), GetParam().values);
    VSIUnlink("/vsimem/typed.tif");
}

INSTANTIATE_TEST_SUITE_P(Types, ReadTypes,
                         ::testing::Values(TypeCase{GDT_Byte, {0, 255}}, TypeCase{GDT_Int16, {-32768, 32767}},
                                           TypeCase{GDT_UInt16, {0, 65535}},
                                           TypeCase{GDT_Int32, {-2147483648.0, 2147483647.0}},
                                           TypeCase{GDT_UInt32, {0, 4294967295.0}},
                                           TypeCase{GDT_Float32, {-0.15625, 8388607.5}},
                                           TypeCase{GDT_Float64, {0.1, -1e300}}),
                         [](const auto& test) { return std::string(GDALGetDataTypeName(test.param.type)); });

class ReadValues : public ReadTest {};

TEST_F(ReadValues, singlePrecisionIsNotRounded) {
    write(path("dem.tif"), {.type = GDT_Float32, .values = {0.1}});
    expect_values(values("dem.tif"), {0.100000001490116119384765625});
}

TEST_F(ReadValues, oneCellOneRowOneColumn) {
    write(path("cell.tif"), {.values = {7}});
    write(path("row.tif"), {.cols = 4, .rows = 1, .values = counting(4)});
    write(path("column.tif"), {.cols = 1, .rows = 4, .values = counting(4)});
    expect_values(values("cell.tif"), {7});
    expect_values(values("row.tif"), {0, 1, 2, 3});
    expect_values(values("column.tif"), {0, 1, 2, 3});
    EXPECT_EQ(open("column.tif")->info().window, (Window{0, 0, 4, 1}));
}

TEST_F(ReadValues, anyBandsOfRowsOfATiledRasterAreTheSame) {
    const int cols = 70;
    const int rows = 150;
    const std::vector<double> expected = counting(cols * rows);
    write(path("tiled.tif"),
          {.cols = cols,
           .rows = rows,
           .values = expected,
           .nodata = 35,
           .creation = {"TILED=YES", "BLOCKXSIZE=32", "BLOCKYSIZE=48", "COMPRESS=DEFLATE"}});
    const std::unique_ptr<DemSource> source = open("tiled.tif");
    for (const std::int32_t step : {1, 7, 48, 149, 150}) {
        std::vector<double> got(expected.size());
        for (std::int32_t row = 0; row < rows; row += step) {
            const std::int32_t count = std::min(step, rows - row);
            source->read(whole_rows(*source, row, count),
                         std::span(got).subspan(static_cast<std::size_t>(row * cols),
                                                static_cast<std::size_t>(count * cols)));
        }
        std::vector<double> wanted = expected;
        wanted[35] = none;
        expect_values(got, wanted);
    }
    std::vector<double> part(50 * 20);
    source->read({30, 35, 50, 20}, part);
    for (std::size_t i = 0; i < part.size(); ++i)
        ASSERT_EQ(part[i], static_cast<double>((30 + i / 20) * cols + 35 + i % 20));
}

TEST_F(ReadValues, scaleAndOffsetAreApplied) {
    const GDALDatasetH dataset = create(
        path("dem.tif"), {.cols = 3, .type = GDT_Int16, .values = {-5, 100, -32768}, .nodata = -32768});
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    GDALSetRasterScale(band, 0.25);
    GDALSetRasterOffset(band, 1000);
    GDALSetRasterUnitType(band, "US survey foot");
    GDALClose(dataset);
    expect_values(values("dem.tif"), {998.75, 1025, none});
    EXPECT_EQ(open("dem.tif")->info().band_unit, "US survey foot");
}

TEST_F(ReadValues, aScaleThatOverflowsGivesNoElevation) {
    const GDALDatasetH dataset = create(path("dem.tif"), {.cols = 2, .values = {2, 1e300}});
    GDALSetRasterScale(GDALGetRasterBand(dataset, 1), 1e10);
    GDALClose(dataset);
    expect_values(values("dem.tif"), {2e10, none});
}

TEST_F(ReadValues, aScaleOfZeroIsRefused) {
    const GDALDatasetH dataset = create(path("dem.tif"), {.values = {2}});
    GDALSetRasterScale(GDALGetRasterBand(dataset, 1), 0);
    GDALSetRasterOffset(GDALGetRasterBand(dataset, 1), 3);
    GDALClose(dataset);
    EXPECT_EQ(message<InputError>("dem.tif"),
              quoted("dem.tif") +
                  " has the scale 0 and the offset 3, which give no elevations; correct them, " +
                  "for example with gdal_edit.py -scale -offset.");
}

TEST_F(ReadValues, theBandIsChosen) {
    const GDALDatasetH dataset = create(path("dem.tif"), {.cols = 2, .values = {1, 2}, .bands = 2});
    std::array<double, 2> second{3, 4};
    ASSERT_EQ(GDALRasterIO(GDALGetRasterBand(dataset, 2), GF_Write, 0, 0, 2, 1, second.data(), 2, 1,
                           GDT_Float64, 0, 0),
              CE_None);
    GDALClose(dataset);
    expect_values(values("dem.tif"), {1, 2});
    options_.band = 2;
    expect_values(values("dem.tif"), {3, 4});
}

TEST_F(ReadValues, rowsOutsideTheWindowAreRefused) {
    write(path("dem.tif"), {.cols = 2, .rows = 3, .values = counting(6)});
    options_.source_window = {0, 1, 2, 2};
    const std::unique_ptr<DemSource> source = open("dem.tif");
    std::vector<double> row(2);
    source->read(whole_rows(*source, 2, 1), row);
    expect_values(row, {4, 5});
    EXPECT_THROW(source->read(whole_rows(*source, 0, 1), row), InputError);
    EXPECT_THROW(source->read(whole_rows(*source, 3, 1), row), InputError);
    EXPECT_THROW(source->read(whole_rows(*source, 1, 2), row), InputError);  // a buffer that is too small
    try {
        source->read(whole_rows(*source, 0, 1), row);
    } catch (const InputError& error) {
        expect_has(error.what(),
                   "1 rows from 0 on and 2 columns from 0 on were asked for outside the window");
    }
}

}  // namespace
}  // namespace d2b::test

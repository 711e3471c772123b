#include <algorithm>
#include <cmath>
#include <limits>

#include "dem2buildings/error.hpp"
#include "read/side_fixture.hpp"

namespace d2b::test {
namespace {

/// Terrain models some of whose values no land has.
class TerrainLimits : public SideTest {
  protected:
    /// 20 x 20 cells of 100, the first `cells` of which have a value. @param side of a cell, and the shift
    void terrain_with(int cells, double value, double cell = 1, double shift = 0) {
        RasterSpec spec{.cols = 20, .rows = 20, .type = GDT_Float32};
        spec.transform = {{500000 + shift, cell, 0, 5538650 - shift, 0, -cell}};
        spec.values.assign(400, 100);
        std::fill_n(spec.values.begin(), cells, value);
        write(path("side.tif"), spec);
    }
    void SetUp() override {
        SideTest::SetUp();
        dem({.cols = 20, .rows = 20, .transform = {{500000, 1, 0, 5538650, 0, -1}}});
    }
};

TEST_F(TerrainLimits, whatNoLandHasIsNoElevationAndSaidSo) {
    terrain_with(3, -9999);
    std::vector<double> expected(400, 100);
    std::fill_n(expected.begin(), 3, std::numeric_limits<double>::quiet_NaN());
    expect_near(terrain(), expected, 0);
    EXPECT_EQ(outside_range_, 3);
    ASSERT_EQ(warnings().size(), 1U);
    EXPECT_EQ(warnings()[0],
              "3 cells of the terrain " + quoted("side.tif") +
                  " have the elevation -9999, outside of the range from -500 to 9000, and are treated as no "
                  "data; declare that with gdal_edit.py -a_nodata -9999, or give the range "
                  "with -zrange.");
}

TEST_F(TerrainLimits, itIsSoBeforeItIsResampled) {
    terrain_with(45, -3.4028234663852886e38, 0.98, 0.3);
    for (const double z : terrain())
        EXPECT_TRUE(std::isnan(z) || std::abs(z - 100) < 1e-9) << z;
    EXPECT_EQ(outside_range_, 45);
    ASSERT_FALSE(warnings().empty());
    EXPECT_NE(warnings().back().find(" have the elevation -3.4028235e+38, outside of "), std::string::npos);
}

TEST_F(TerrainLimits, everyCellIsCountedOnceWhereverPartsOverlap) {
    for (const bool resampled : {false, true}) {
        if (resampled)
            terrain_with(45, 9999, 0.98, 0.3);
        else
            terrain_with(45, 9999);
        const auto source = open_terrain(path("side.tif"), grid_, 1, land_elevations, callbacks_);
        std::vector<double> cells(12 * 9);
        EXPECT_EQ(source->cells_outside_range(), 0);
        for (const std::int32_t row : {8, 4, 0})
            for (const std::int32_t col : {0, 11, 6}) {
                EXPECT_TRUE(source->take_warnings().empty());  // it is judged when all of it has been read
                source->read({row, col, 12, 9}, cells);
            }
        EXPECT_EQ(source->cells_outside_range(), 45) << resampled;
    }
}

TEST_F(TerrainLimits, everyCellIsCountedOnceHoweverOftenItIsRead) {
    terrain_with(45, 9999, 0.98, 0.3);
    const auto source = open_terrain(path("side.tif"), grid_, 1, land_elevations, callbacks_);
    std::vector<double> rows(20 * 12);
    for (const std::int32_t row : {0, 4, 8})
        source->read(whole_rows(*source, row, 12), rows);
    EXPECT_EQ(source->cells_outside_range(), 45);
    terrain_with(45, 9999);
    const auto same_cells = open_terrain(path("side.tif"), grid_, 1, land_elevations, callbacks_);
    for (const std::int32_t row : {0, 4, 8})
        same_cells->read(whole_rows(*same_cells, row, 12), rows);
    EXPECT_EQ(same_cells->cells_outside_range(), 45);
}

TEST_F(TerrainLimits, theyAreInTheTerrainsOwnUnit) {
    terrain_with(3, -1600);
    const GDALDatasetH dataset = GDALOpen(path("side.tif").c_str(), GA_Update);
    GDALSetRasterUnitType(GDALGetRasterBand(dataset, 1), "ft");
    GDALClose(dataset);
    (void)terrain();
    EXPECT_EQ(outside_range_, 0);
}

TEST_F(TerrainLimits, whereMostAreNoneItIsRefused) {
    terrain_with(201, 30000);
    EXPECT_EQ(
        refused<InputError>([&] { (void)terrain(); }),
        "201 cells of the terrain " + quoted("side.tif") +
            " have the elevation 30000, outside of the range from -500 to 9000 and more than half of all; "
            "correct its unit with gdal_edit.py -units or its NoData value with gdal_edit.py -a_nodata, or "
            "give "
            "the range with -zrange.");
}

TEST_F(TerrainLimits, undeclaredNoDataIsNoElevationAndSaidSo) {
    for (const double cell : {1.0, 0.98}) {
        terrain_with(60, 0, cell, cell == 1 ? 0 : 0.1);  // three rows
        warnings_.clear();
        for (const double z : terrain())
            EXPECT_TRUE(std::isnan(z) || std::abs(z - 100) < 1e-9) << z;
        EXPECT_EQ(outside_range_, 60);
        ASSERT_FALSE(warnings().empty());
        EXPECT_EQ(
            warnings().back(),
            "60 cells of the terrain " + quoted("side.tif") +
                " have the elevation 0, lie at its edge, and all around is at least 2 m higher or lower, so "
                "they are treated as no data; declare that with gdal_edit.py -a_nodata 0, or keep the "
                "elevation with -inodata.");
    }
    terrain_with(60, 0);
    const auto kept =
        open_terrain(path("side.tif"), grid_, 1, land_elevations, callbacks_, {.keeps_undeclared = true});
    std::vector<double> row(20);
    kept->read(whole_rows(*kept, 0, 1), row);
    expect_values(row, std::vector<double>(20, 0));
}

TEST_F(TerrainLimits, lessOfItIsNamedAlone) {
    RasterSpec spec{
        .cols = 40, .rows = 40, .type = GDT_Float32, .transform = {{500000, 0.5, 0, 5538650, 0, -0.5}}};
    spec.values.assign(1600, 100);
    std::fill_n(spec.values.begin(), 80, 0);
    write(path("side.tif"), spec);
    EXPECT_LT(terrain().front(), 60);
    EXPECT_EQ(outside_range_, 0);
    ASSERT_EQ(warnings().size(), 1U);
    EXPECT_EQ(
        warnings()[0],
        "80 cells of the terrain " + quoted("side.tif") +
            " have the elevation 0, lie at its edge, and all around is at least 2 m higher or lower; if it "
            "stands for no data, declare that with gdal_edit.py -a_nodata 0, and if not, give -inodata.");
}

}  // namespace
}  // namespace d2b::test

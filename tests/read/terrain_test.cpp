#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "dem2buildings/error.hpp"
#include "read/side_fixture.hpp"

namespace d2b::reading {
namespace {

using namespace test;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double millimetre = 0.001;

/// 60 x 40 cells of half a metre in UTM 32, from (500000, 5538650) to (500030, 5538630).
RasterSpec city() {
    return {.cols = 60, .rows = 40, .type = GDT_Float32, .transform = {{500000, 0.5, 0, 5538650, 0, -0.5}}};
}

class Terrain : public SideTest {};

TEST_F(Terrain, equalGridsKeepTheirBits) {
    RasterSpec spec = city();
    for (int i = 0; i < spec.cols * spec.rows; ++i)
        spec.values.push_back(i % 7 == 0 ? -9999 : 300 + std::sin(i));
    spec.nodata = -9999;
    write(path("side.tif"), spec);
    dem(spec);
    const std::vector<double> got = terrain();
    const std::vector<double> all = values("dem.tif");
    EXPECT_EQ(std::memcmp(got.data(), all.data(), all.size() * sizeof(double)), 0);
    options_.source_window = {7, 3, 20, 11};
    dem(spec);
    const std::vector<double> part = terrain();
    const std::vector<double> window = values("dem.tif");
    ASSERT_EQ(part.size(), 220U);
    EXPECT_EQ(std::memcmp(part.data(), window.data(), part.size() * sizeof(double)), 0);
    EXPECT_TRUE(warnings().empty());
}

TEST_F(Terrain, theGridIsTheDems) {
    options_.source_window = {7, 3, 20, 11};
    dem(city());
    side({.cols = 30, .rows = 30, .transform = {{499990, 2, 0, 5538660, 0, -2}}}, plane);
    const auto source = open_terrain(path("side.tif"), grid_, 1, land_elevations, callbacks_);
    EXPECT_EQ(source->info().name, path("side.tif"));
    EXPECT_EQ(source->info().transform, grid_.transform);
    EXPECT_EQ(source->info().window, (Window{3, 7, 11, 20}));
    EXPECT_EQ(source->info().crs_wkt, grid_.crs_wkt);
}

TEST_F(Terrain, theSameCellsOfAnotherExtent) {
    dem({.cols = 4, .rows = 4, .transform = {{100, 1, 0, 200, 0, -1}}});
    write(path("side.tif"),
          {.cols = 3, .rows = 5, .values = counting(15, 1), .transform = {{102, 1, 0, 199, 0, -1}}});
    expect_values(terrain(), {none, none, none, none,  //
                              none, none, 1, 2,        //
                              none, none, 4, 5,        //
                              none, none, 7, 8});
    EXPECT_EQ(warnings(), (std::vector<std::string>{"About 63 % of '" + path("dem.tif") +
                                                    "' lies outside of the terrain " + quoted("side.tif") +
                                                    "; there is no ground there."}));
    const auto source = open_terrain(path("side.tif"), grid_, 1, land_elevations, callbacks_);
    std::vector<double> row(4);
    source->read(whole_rows(*source, 2, 1), row);
    expect_values(row, {none, none, 4, 5});
}

TEST_F(Terrain, aCoarserGrid) {
    dem(city());
    for (const double cell : {0.6, 2.0, 7.3, 30.0}) {
        const int n = static_cast<int>(120 / cell) + 2;
        side({.cols = n, .rows = n, .transform = {{499951.3, cell, 0, 5538699.1, 0, -cell}}}, plane);
        expect_near(terrain(), expected(plane), 1e-9);
    }
    EXPECT_TRUE(warnings().empty());
}

TEST_F(Terrain, aFinerGridIsAveraged) {
    dem({.cols = 20, .rows = 10, .transform = {{500000, 1, 0, 5538650, 0, -1}}});
    RasterSpec fine{.cols = 300, .rows = 200, .transform = {{499995.07, 0.1, 0, 5538655.03, 0, -0.1}}};
    side(fine, plane);
    expect_near(terrain(), expected(plane), 1e-9);
    // Cells of 10 cm that are 1 m above and below the plane in turn: a single cell would be off by 1 m.
    int cell = 0;
    side(fine, [&cell](double x, double y) {
        const int sign = (cell + cell / 300) % 2 == 0 ? 1 : -1;
        ++cell;
        return plane(x, y) + sign;
    });
    expect_near(terrain(), expected(plane), 0.01);
}

TEST_F(Terrain, anotherProjection) {
    dem(city());
    // In UTM 33 the place is some 430 km to the west of the central meridian, and the grid turned by 4.6
    // degrees.
    side({.cols = 120, .rows = 120, .transform = {{70100, 1, 0, 5555960, 0, -1}}, .crs = "EPSG:25833"}, plane,
         "EPSG:25832");
    const std::vector<double> far = terrain();
    ASSERT_FALSE(std::isnan(far[0])) << "the raster of this test does not cover the DEM";
    expect_near(far, expected(plane), millimetre);
    EXPECT_TRUE(warnings().empty());
}

TEST_F(Terrain, degreesUnderMetres) {
    dem(city());
    side({.cols = 100, .rows = 100, .transform = {{8.9999, 1e-5, 0, 50.0004, 0, -1e-5}}, .crs = "EPSG:4258"},
         plane, "EPSG:25832");
    expect_near(terrain(), expected(plane), millimetre);
}

TEST_F(Terrain, metresUnderDegrees) {
    dem({.cols = 30, .rows = 20, .transform = {{9.0001, 5e-6, 0, 50.0002, 0, -5e-6}}, .crs = "EPSG:4258"});
    const Surface tilted = [](double lon, double lat) { return 100 + 3000 * (lon - 9) + 2000 * (lat - 50); };
    side({.cols = 60, .rows = 60, .transform = {{499990, 1, 0, 5538670, 0, -1}}}, tilted, "EPSG:4258");
    expect_near(terrain(), expected(tilted), millimetre);
}

TEST_F(Terrain, rotatedAndShearedGrids) {
    const std::vector<std::array<double, 6>> grids{{500000, 0.4, 0.3, 5538650, 0.3, -0.4},  // turned
                                                   {500000, 0.5, 0.2, 5538650, 0, -0.5},    // sheared
                                                   {500000, 0.5, 0, 5538630, 0, 0.5},       // south up
                                                   {500020, 0, -0.5, 5538640, -0.5, 0}};    // on its side
    for (const auto& grid : grids) {
        RasterSpec spec = city();
        spec.transform = grid;
        dem(spec);
        side({.cols = 70, .rows = 70, .transform = {{499969, 1.1, 0, 5538679, 0, -1.1}}}, plane);
        expect_near(terrain(), expected(plane), 1e-9);
        side({.cols = 90, .rows = 90, .transform = {{499960, 0.9, 0.5, 5538645, 0.5, -0.9}}}, plane);
        expect_near(terrain(), expected(plane), 1e-9);
    }
}

TEST_F(Terrain, bandsAndWindowsGiveTheSameBits) {
    RasterSpec wide = city();
    wide.cols = 1300;
    dem(wide);
    side(
        {.cols = 900, .rows = 200, .transform = {{70000, 1, 0, 5556000, 0, -1}}, .crs = "EPSG:25833"},
        [](double x, double y) { return std::sin(x) * std::cos(y); }, "EPSG:25832");
    const std::vector<double> all = terrain();
    ASSERT_FALSE(std::isnan(all.front() + all.back()));
    options_.source_window = {500, 13, 601, 9};
    dem(wide);
    const auto source = open_terrain(path("side.tif"), grid_, 1, land_elevations, callbacks_);
    std::vector<double> row(601);
    for (int i = 13; i < 22; ++i) {
        source->read(whole_rows(*source, i, 1), row);
        EXPECT_EQ(std::memcmp(row.data(), all.data() + i * 1300 + 500, row.size() * sizeof(double)), 0) << i;
    }
}

TEST_F(Terrain, anyPartOfTheWindowHasTheSameBits) {
    RasterSpec wide = city();
    wide.cols = 1300;
    wide.rows = 90;
    dem(wide);
    side(
        {.cols = 900, .rows = 200, .transform = {{70000, 1, 0, 5556000, 0, -1}}, .crs = "EPSG:25833"},
        [](double x, double y) { return std::sin(x) * std::cos(y); }, "EPSG:25832");
    const std::vector<double> all = terrain();
    const auto source = open_terrain(path("side.tif"), grid_, 1, land_elevations, callbacks_);
    std::mt19937 random(7);
    const auto below = [&](std::int32_t n) {
        return static_cast<std::int32_t>(random() % static_cast<unsigned>(n));
    };
    for (int k = 0; k < 60; ++k) {
        Window part{below(90), below(1300), 0, 0};
        part.rows = 1 + below(90 - part.row);
        part.cols = 1 + below(1300 - part.col);
        std::vector<double> cells(static_cast<std::size_t>(part.points()));
        source->read(part, cells);
        for (std::int32_t i = 0; i < part.rows; ++i)
            ASSERT_EQ(std::memcmp(cells.data() + std::ptrdiff_t{i} * part.cols,
                                  all.data() + std::ptrdiff_t{part.row + i} * 1300 + part.col,
                                  static_cast<std::size_t>(part.cols) * sizeof(double)),
                      0)
                << "row " << part.row + i << " from column " << part.col << " on, " << part.cols
                << " of them";
    }
}

TEST_F(Terrain, whatIsNotValidIsLeftOut) {
    dem({.cols = 8, .transform = {{0, 0.5, 0, 0, 0, -1}}});
    // Centres at 0.25, 0.75, ...; cells of the terrain from 0 to 1, 1 to 2, 2 to 3, 3 to 4, centres at 0.5
    // and so on. Next to missing cells a value goes on level.
    for (const double missing : {-9999.0, none, inf}) {
        write(path("side.tif"),
              {.cols = 4, .rows = 2, .values = {10, 20, missing, 40, 10, 20, missing, 40}, .nodata = -9999});
        expect_values(terrain(), {10, 12.5, 17.5, 20, none, none, 40, 40});
    }
}

TEST_F(Terrain, aMaskOfTheDatasetCounts) {
    dem({.cols = 4, .transform = {{0, 0.5, 0, 0, 0, -1}}});
    const GDALDatasetH dataset = create(path("side.tif"), {.cols = 2, .values = {7, 8}});
    GDALCreateDatasetMaskBand(dataset, GMF_PER_DATASET);
    std::array<GByte, 2> valid{255, 0};
    ASSERT_EQ(GDALRasterIO(GDALGetMaskBand(GDALGetRasterBand(dataset, 1)), GF_Write, 0, 0, 2, 1, valid.data(),
                           2, 1, GDT_Byte, 0, 0),
              CE_None);
    GDALClose(dataset);
    expect_values(terrain(), {7, 7, none, none});
}

TEST_F(Terrain, aPartThatHasNoImage) {
    // The back of the earth has none in an orthographic projection; 512 columns are 64 degrees.
    dem({.cols = 2880, .rows = 2, .transform = {{-180, 0.125, 0, 0.125, 0, -0.125}}, .crs = "EPSG:4326"});
    write(path("side.tif"), {.cols = 2,
                             .rows = 2,
                             .values = {5, 5, 5, 5},
                             .transform = {{-1e6, 1e6, 0, 1e6, 0, -1e6}},
                             .crs = "+proj=ortho +lat_0=0 +lon_0=0 +ellps=sphere"});
    const std::vector<double> got = terrain();
    EXPECT_EQ(got[1440], 5);
    EXPECT_TRUE(std::isnan(got[0]));
    EXPECT_TRUE(std::isnan(got[2879]));
    EXPECT_EQ(warnings().at(0), "About 95 % of '" + path("dem.tif") + "' lies outside of the terrain " +
                                    quoted("side.tif") + "; there is no ground there.");
}

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
        EXPECT_EQ(warnings().back(),
                  "60 cells of the terrain " + quoted("side.tif") +
                      " have the elevation 0, lie at its edge, and most cells around are at least 2 m higher "
                      "or lower, so "
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

TEST_F(TerrainLimits, valuesBlendedWithNoDataAreNoElevationAndSaidSo) {
    for (const bool declared : {false, true}) {
        dem({.cols = 60, .rows = 60, .transform = {{500000, 1, 0, 5538650, 0, -1}}});
        RasterSpec spec{.cols = 60, .rows = 60, .type = GDT_Float32};
        spec.transform = {{500000, 1, 0, 5538650, 0, -1}};
        if (declared)
            spec.nodata = 0;
        for (int i = 0; i < 3600; ++i)
            spec.values.push_back(i < 600 ? 0 : i < 660 ? 40 : 100 + 0.001 * i);
        write(path("side.tif"), spec);
        warnings_.clear();
        const std::vector<double> read = terrain();
        for (std::size_t i = 0; i < read.size(); ++i)
            EXPECT_TRUE(i < 720 ? std::isnan(read[i]) : std::abs(read[i] - spec.values[i]) < 1e-4) << i;
        EXPECT_EQ(outside_range_, declared ? 120 : 720);
        ASSERT_FALSE(warnings().empty());
        EXPECT_EQ(warnings().back(),
                  "120 cells of the terrain " + quoted("side.tif") +
                      " have values blended with 0 beside cells without data, as resampling does before that "
                      "is declared as NoData, so they are treated as no data; resample the original raster "
                      "again, for example with gdalwarp -srcnodata 0.");
    }
}

TEST_F(TerrainLimits, aHoleFarBelowIsNamed) {
    RasterSpec spec{
        .cols = 40, .rows = 40, .type = GDT_Float32, .transform = {{500000, 0.5, 0, 5538650, 0, -0.5}}};
    for (int i = 0; i < 1600; ++i) {
        const bool hole = i / 40 >= 10 && i / 40 < 20 && i % 40 >= 10 && i % 40 < 20;
        spec.values.push_back(hole ? 0 : 100 + 0.001 * i);
    }
    write(path("side.tif"), spec);
    (void)terrain();
    ASSERT_EQ(warnings().size(), 1U);
    EXPECT_EQ(warnings()[0],
              "100 cells of the terrain " + quoted("side.tif") +
                  " have the elevation 0, more than 50 m from any other; if it stands for no data, declare "
                  "that with gdal_edit.py -a_nodata 0.");
}

/// A terrain that was cut out below buildings.
TEST_F(TerrainLimits, holesBelowAllOthersAreNamed) {
    const auto said = [&](double ground, int rows) {
        RasterSpec spec{
            .cols = 40, .rows = 40, .type = GDT_Float32, .transform = {{500000, 0.5, 0, 5538650, 0, -0.5}}};
        for (int i = 0; i < 1600; ++i)
            spec.values.push_back(
                i / 40 % 10 > 9 - rows && i / 40 < 39 && i % 10 > 3 && i % 40 < 39 ? 0 : ground + 0.001 * i);
        write(path("side.tif"), spec);
        warnings_.clear();
        (void)terrain();
        return warnings().empty() ? std::string() : warnings().back();
    };
    // 19 rows of 23 cells.
    EXPECT_EQ(said(10, 5),
              "437 cells of the terrain " + quoted("side.tif") +
                  " have the elevation 0, more than 2 m below any other; if it stands for no data, "
                  "declare that with gdal_edit.py -a_nodata 0, and if not, give -inodata.");
    EXPECT_EQ(said(1.5, 5), "");
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
            " have the elevation 0, lie at its edge, and most cells around are at least 2 m higher or lower; "
            "if it "
            "stands for no data, declare that with gdal_edit.py -a_nodata 0, and if not, give -inodata.");
}

TEST_F(TerrainLimits, aSecondNoDataValueCannotBeDeclared) {
    RasterSpec spec{
        .cols = 40, .rows = 40, .type = GDT_Float32, .transform = {{500000, 0.5, 0, 5538650, 0, -0.5}}};
    spec.nodata = 255;
    spec.values.assign(1600, 100);
    std::fill_n(spec.values.begin(), 240, 0);
    std::fill_n(spec.values.rbegin(), 40, 255);
    write(path("side.tif"), spec);
    (void)terrain();
    ASSERT_FALSE(warnings().empty());
    EXPECT_NE(warnings()[0].find(
                  "; set these cells to the NoData value 255, for example with gdal_calc.py "
                  "--calc=\"where(A==0,255,A)\" --NoDataValue=255, or keep the elevation with -inodata."),
              std::string::npos)
        << warnings()[0];
}

class TerrainUnits : public SideTest {
  protected:
    void one_cell(const std::string& unit, const std::string& crs = "EPSG:25832") {
        const GDALDatasetH dataset = create(path("side.tif"), {.values = {100}, .crs = crs});
        GDALSetRasterUnitType(GDALGetRasterBand(dataset, 1), unit.c_str());
        GDALClose(dataset);
    }
};

TEST_F(TerrainUnits, ofTheBand) {
    dem({});
    one_cell("ft");
    EXPECT_DOUBLE_EQ(terrain().at(0), 30.48);
    one_cell("US survey foot");
    EXPECT_DOUBLE_EQ(terrain().at(0), 120000.0 / 3937);
    one_cell("m");
    EXPECT_EQ(terrain().at(0), 100);
    // A DEM in feet: 100 m are 328.08399 ft, and feet are feet.
    EXPECT_NEAR(terrain(0.3048).at(0), 328.0839895, 1e-7);
    one_cell("ft");
    EXPECT_EQ(terrain(0.3048).at(0), 100);
}

TEST_F(TerrainUnits, ofTheVerticalCrs) {
    dem({.crs = "EPSG:2229"});
    one_cell("", "EPSG:2229+6360");  // NAVD88 in US survey feet
    EXPECT_DOUBLE_EQ(terrain().at(0), 120000.0 / 3937);
    one_cell("", "EPSG:2229+5703");  // NAVD88 in metres
    EXPECT_EQ(terrain().at(0), 100);
    EXPECT_DOUBLE_EQ(terrain(0.3048).at(0), 100 / 0.3048);
    EXPECT_TRUE(warnings().empty());
}

TEST_F(TerrainUnits, unknownOnesAreTheDems) {
    dem({});
    for (const char* unit : {"", "unknown"}) {
        one_cell(unit);
        EXPECT_EQ(terrain(1).at(0), 100);
        EXPECT_EQ(terrain(0.3048).at(0), 100);
    }
    one_cell("floors");
    EXPECT_EQ(refused<InputError>([&] { (void)terrain(1); }),
              "The unit of terrain " + quoted("side.tif") +
                  " is 'floors', which is not a known unit of length; if the values are elevations, give "
                  "their unit with gdal_edit.py -units, for example gdal_edit.py -units m.");
}

TEST_F(TerrainUnits, aPlaneInFeetOfAnotherCrsAndScale) {
    dem({.cols = 40, .rows = 30, .transform = {{500000, 0.5, 0, 5538650, 0, -0.5}}});
    RasterSpec spec{.cols = 100, .rows = 100, .type = GDT_Int32};
    spec.transform = {{8.9999, 1e-5, 0, 50.0004, 0, -1e-5}};
    spec.crs = "EPSG:4258";
    side(
        spec, [](double x, double y) { return std::round((plane(x, y) / 0.3048 - 200) * 10000); },
        "EPSG:25832");
    const GDALDatasetH dataset = GDALOpen(path("side.tif").c_str(), GA_Update);
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    GDALSetRasterUnitType(band, "foot");
    GDALSetRasterScale(band, 0.0001);
    GDALSetRasterOffset(band, 200);
    GDALClose(dataset);
    expect_near(terrain(), expected(plane), 0.001);
}

TEST_F(TerrainUnits, datumsThatDifferAreSaid) {
    dem({.crs = "EPSG:25832+5773"});  // above EGM96
    one_cell("", "EPSG:25832+7837");  // above DHHN2016
    EXPECT_EQ(terrain().at(0), 100);
    EXPECT_EQ(warnings(),
              (std::vector<std::string>{
                  "Heights of the terrain " + quoted("side.tif") +
                  " are above Deutsches Haupthoehennetz 2016 and those of " + quoted("dem.tif") +
                  " above EGM96 geoid; they are compared as they are, so convert one of them with gdalwarp "
                  "first."}));
    dem({.crs = "EPSG:4979"});
    one_cell("", "EPSG:4326+5773");
    EXPECT_EQ(terrain().at(0), 100);
    ASSERT_EQ(warnings().size(), 1U);
    expect_has(warnings()[0], " are above EGM96 geoid and those of " + quoted("dem.tif") +
                                  " above the ellipsoid; they are compared as they are");
    dem({.crs = "EPSG:4979"});
    one_cell("", "EPSG:4979");
    EXPECT_EQ(terrain().at(0), 100);
    EXPECT_TRUE(warnings().empty());
}

}  // namespace
}  // namespace d2b::reading

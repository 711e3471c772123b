#include <cmath>
#include <cstring>
#include <random>

#include "read/side_fixture.hpp"

namespace d2b::test {
namespace {

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
    // and so on. Next to what is missing a value goes on level.
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

}  // namespace
}  // namespace d2b::test

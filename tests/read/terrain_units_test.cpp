#include "read/side_fixture.hpp"

namespace d2b::test {
namespace {

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
    EXPECT_EQ(
        refused<InputError>([&] { (void)terrain(1); }),
        "The unit of terrain " + quoted("side.tif") +
            " is 'floors', which is no known unit of length; if the values are elevations, give their unit "
            "with gdal_edit.py -units, for example gdal_edit.py -units m.");
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
}  // namespace d2b::test

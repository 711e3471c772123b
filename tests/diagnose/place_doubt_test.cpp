#include <gtest/gtest.h>

#include "diagnose/warnings.hpp"

namespace d2b {
namespace {

DemInfo raster(const AffineTransform& transform) {
    DemInfo dem;
    dem.name = "dem.tif";
    dem.rows = 300;
    dem.cols = 400;
    dem.window = {0, 0, 300, 400};
    dem.transform = transform;
    dem.georeferenced = true;
    return dem;
}

TEST(PictureDoubt, ThreeBandsOrBytes) {
    DemInfo dem = raster({0, 1, 0, 0, 0, -1});
    EXPECT_EQ(picture_warning(dem), "");
    dem.bands = 2;
    EXPECT_EQ(picture_warning(dem), "");
    dem.bytes = true;
    EXPECT_EQ(picture_warning(dem),
              "'dem.tif' has byte values, like a picture; give a surface model (DSM), or choose the band of "
              "its elevations with -b");
    dem.bands = 3;
    EXPECT_EQ(picture_warning(dem).find("'dem.tif' has 3 bands of byte values, like a picture"), 0U);
    dem.bytes = false;
    EXPECT_EQ(picture_warning(dem).find("'dem.tif' has 3 bands, like a picture"), 0U);
}

TEST(DegreesDoubt, SmallCellsWithin180WithoutACrs) {
    const DemInfo dem = raster({13.4, 1e-5, 0, 52.5, 0, -1e-5});
    EXPECT_EQ(degrees_warning(dem, false),
              "'dem.tif' has no CRS, and its coordinates look like degrees, but were taken as metres; give "
              "-a_srs EPSG:4326 if they are degrees, else their CRS");
    EXPECT_EQ(degrees_warning(dem, true), "");
    EXPECT_EQ(degrees_warning(raster({13.4, 0.5, 0, 52.5, 0, -0.5}), false), "") << "a local system";
    EXPECT_EQ(degrees_warning(raster({181, 1e-5, 0, 52.5, 0, -1e-5}), false), "");
    EXPECT_EQ(degrees_warning(raster({13.4, 1e-5, 0, 90.1, 0, -1e-5}), false), "");
    DemInfo pixels = dem;
    pixels.georeferenced = false;
    EXPECT_EQ(degrees_warning(pixels, false), "");
}

TEST(ExtentDoubt, LessThanABuilding) {
    EXPECT_EQ(extent_warning("dem.tif", 100, 50), "");
    EXPECT_EQ(extent_warning("dem.tif", 0.0512, 0.2),
              "'dem.tif' covers 0.0512 m x 0.2 m, which is less than a building; give the right CRS with "
              "-a_srs, or a larger part of the raster");
    EXPECT_NE(extent_warning("dem.tif", 1000, 2), "") << "a strip";
    EXPECT_NE(extent_warning("dem.tif", 5, 5), "");
}

}  // namespace
}  // namespace d2b

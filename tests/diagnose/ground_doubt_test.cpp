#include <vector>

#include <gtest/gtest.h>

#include "diagnose/coverage.hpp"
#include "diagnose/ground_fit.hpp"

namespace d2b {
namespace {

/// So many cells of a height above the ground, and so many of another.
GroundFit heights(int bare, float low, int raised, float high, double min_height = 2) {
    GroundFit fit(min_height);
    std::vector<float> surface(static_cast<std::size_t>(bare), low);
    surface.resize(static_cast<std::size_t>(bare + raised), high);
    fit.add(surface, std::vector<float>(surface.size(), 0.0F));
    return fit;
}

std::string doubt(const GroundFit& fit, GroundMode mode) {
    return ground_warning(fit, mode, mode == GroundMode::given ? "dtm.tif" : "");
}

TEST(GroundDoubt, NoneOfATown) {
    for (const GroundMode mode : {GroundMode::automatic, GroundMode::given, GroundMode::none}) {
        EXPECT_EQ(doubt(heights(600, 0.1F, 400, 12), mode), "");
        EXPECT_EQ(doubt(heights(50, 0.1F, 950, 12), mode), "") << "5 % are enough";
        EXPECT_EQ(doubt(heights(600, -1.9F, 400, 12), mode), "");
        EXPECT_EQ(doubt(GroundFit(2), mode), "") << "nothing is known";
    }
}

TEST(GroundDoubt, ATerrainThatIsTooHigh) {
    EXPECT_EQ(doubt(heights(600, -43.1F, 400, -31), GroundMode::given),
              "the terrain 'dtm.tif' lies 43 m above the surface where nothing stands on it (median); check "
              "whether both have the same unit and vertical datum");
}

TEST(GroundDoubt, ATerrainThatIsTooLow) {
    EXPECT_EQ(
        doubt(heights(600, 43.1F, 400, 55), GroundMode::given),
        "only 0 % of the cells lie within 2 m of the terrain 'dtm.tif', above which the surface lies 43 m "
        "(median); check whether both have the same unit and vertical datum");
    EXPECT_EQ(doubt(heights(600, 5.1F, 400, 55, 10), GroundMode::given),
              "the terrain 'dtm.tif' lies 5.1 m below the surface where nothing stands on it (median); check "
              "whether both have the same unit and vertical datum");
}

TEST(GroundDoubt, ElevationsTakenAsHeights) {
    EXPECT_EQ(doubt(heights(0, 0, 1000, 248.1F), GroundMode::none),
              "-ground none takes elevations as heights above the ground, and their median is 248 m; give a "
              "terrain model with -ground, or leave -ground out to have the ground estimated");
}

TEST(GroundDoubt, DepthsTakenAsHeights) {
    EXPECT_EQ(
        doubt(heights(990, -30.1F, 10, 3), GroundMode::none)
            .find(
                "-ground none takes elevations as heights above the ground, and their median is -30 m where "
                "they are low; "),
        0U);
}

TEST(GroundDoubt, NextToNoGroundToEstimateFrom) {
    EXPECT_EQ(doubt(heights(3, 0, 997, 9), GroundMode::automatic),
              "only 0.3 % of the cells lie within 2 m of the ground that was estimated; give a terrain model "
              "with -ground, or use a larger part of the raster");
}

TEST(SurfaceDoubt, OfATerrainModel) {
    EXPECT_EQ(
        surface_warning(heights(1000, 0.1F, 0, 0), "dem.tif"),
        "none of the cells of 'dem.tif' rise by more than 2 m above their surroundings, as in a terrain "
        "model (DTM), which has no buildings; give the surface model (DSM)");
    EXPECT_EQ(surface_warning(heights(10000, 0.1F, 9, 3), "dem.tif").find("less than 0.1 % of the cells"),
              0U);
    EXPECT_EQ(surface_warning(heights(10000, 0.1F, 100, 3), "dem.tif"), "");
    EXPECT_EQ(surface_warning(GroundFit(2), "dem.tif"), "");
}

TEST(SideDoubt, OfWhatHasNoValidCell) {
    Options options;
    options.ground.terrain = "t.tif";
    options.detect.mask = "m.tif";
    options.detect.ndvi = "n.tif";
    EXPECT_EQ(empty_auxiliary_warning({}, options), "");
    EXPECT_EQ(ndvi_warning({}, options), "");
    EXPECT_EQ(
        empty_auxiliary_warning({false, true, true}, options),
        "the terrain 't.tif' has no valid cell over the DEM; give one of the same place with -ground, or "
        "leave -ground out to have the ground estimated");
    EXPECT_EQ(
        empty_auxiliary_warning({true, false, true}, options),
        "the mask 'm.tif' has no cell over the DEM that is neither 0 nor NoData; give one with -mask that "
        "marks where buildings may be");
    EXPECT_EQ(ndvi_warning({true, true, false}, options),
              "the NDVI 'n.tif' has no valid cell over the DEM, so it shows no plants; give one of the same "
              "place with -ndvi");
}

}  // namespace
}  // namespace d2b

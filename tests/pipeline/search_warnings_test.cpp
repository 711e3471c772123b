#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/crs.hpp"
#include "pipeline/made_town.hpp"

namespace d2b::test {
namespace {

using Texts = std::vector<std::string>;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::vector<double> raised(std::vector<double> z, double by) {
    for (double& value : z)
        value += by;
    return z;
}

/// A surface with single cells far above the ground, as shades are.
std::vector<double> lit(std::vector<double> z, int cells) {
    for (int i = 0; i < cells; ++i)
        z[MadeTown::index(60, 10 + 20 * i)] = 250;
    return z;
}

/// How each of a run's warnings begins.
Texts beginnings(const TownRun& town, std::size_t length) {
    Texts texts = town.report.warnings;
    for (std::string& text : texts)
        text.resize(std::min(length, text.size()));
    return texts;
}

/// Exactly one warning, that begins so.
void expect_warning(TownRun& town, const std::string& beginning) {
    town.run();
    EXPECT_EQ(beginnings(town, beginning.size()), Texts{beginning});
    EXPECT_TRUE(town.sink.finished);
}

/// A run with a terrain model that is off by some metres.
struct WithTerrain : TownRun {
    explicit WithTerrain(double by, double min_height = 2)
        : source(MadeTown::source(raised(MadeTown::terrain(), by))) {
        options.ground.mode = GroundMode::given;
        options.ground.terrain = "dtm.tif";
        options.detect.min_height = min_height;
        terrain = &source;
    }
    MemorySource source;
};

TEST(SearchWarnings, NoneOfAGoodTown) {
    TownRun town;
    town.run();
    EXPECT_EQ(town.count(), 3U);
    EXPECT_EQ(town.report.warnings, Texts{});
    WithTerrain good(0.2);
    good.run();
    EXPECT_EQ(good.report.warnings, Texts{});
    TownRun heights(MadeTown::heights());
    heights.options.ground.mode = GroundMode::none;
    heights.run();
    EXPECT_EQ(heights.report.warnings, Texts{});
}

TEST(SearchWarnings, ATerrainModelThatDoesNotFit) {
    WithTerrain low(-43);
    expect_warning(low,
                   "Only 0 % of the cells lie within 2 m of the terrain 'dtm.tif', above which the surface "
                   "lies 43 m (median)");
    WithTerrain high(43);
    expect_warning(high,
                   "No building was found: the terrain 'dtm.tif' lies 43 m above the surface where nothing "
                   "stands on it (median)");
    WithTerrain lower(-3, 5);
    lower.run();
    EXPECT_EQ(beginnings(lower, 40), Texts{"The terrain 'dtm.tif' lies 3.1 m below t"});
}

TEST(SearchWarnings, ATerrainModelWithNoDataWhereTheSurfaceHasNone) {
    WithTerrain gap(0);
    std::vector<double> ground = MadeTown::terrain();
    for (int row = 0; row < MadeTown::rows; ++row)
        for (int col = 0; col < 17; ++col)
            ground[MadeTown::index(row, col)] = unknown;
    MemorySource ground_with_gap = MadeTown::source(ground);
    gap.terrain = &ground_with_gap;
    expect_warning(
        gap,
        "10 % of the cells of 'memory' that have an elevation have none in the terrain 'dtm.tif'; there "
        "is no ground there, and buildings are cut off or missing, so fill its NoData, for example with "
        "gdal_fillnodata.py, or leave -ground out to have the ground estimated.");
    std::vector<double> surface = MadeTown::surface();
    for (std::size_t i = 0; i < surface.size(); ++i)
        if (std::isnan(ground[i]))
            surface[i] = unknown;
    TownRun both(surface);
    both.options.ground.mode = GroundMode::given;
    both.options.ground.terrain = "dtm.tif";
    both.terrain = &ground_with_gap;
    both.run();
    EXPECT_EQ(both.report.warnings, Texts{});
}

TEST(SearchWarnings, ARasterWhoseGroundIsNoData) {
    std::vector<double> z = MadeTown::heights();
    for (double& height : z)
        if (height < 2)
            height = unknown;
    TownRun heights(z);
    heights.run();
    EXPECT_TRUE(std::ranges::any_of(heights.report.warnings, [](const std::string& said) {
        return said.find("has elevations in ") != std::string::npos &&
               said.find("-ground none") != std::string::npos;
    }));
    TownRun right(z);
    right.options.ground.mode = GroundMode::none;
    right.run();
    EXPECT_EQ(right.report.warnings, Texts{});
    EXPECT_EQ(right.count(), 3U);
    for (double& height : z)
        height += 100;  // elevations of roofs
    TownRun elevations(z);
    elevations.options.ground.mode = GroundMode::none;
    expect_warning(elevations,
                   "-ground none takes elevations as heights above the ground, and their median is 10");
}

TEST(SearchWarnings, ElevationsThatWereRounded) {
    std::vector<double> z = MadeTown::surface();
    for (double& each : z)
        each = std::floor(each);
    TownRun rounded(z);
    rounded.run();
    EXPECT_EQ(rounded.report.sampling.value().value_step, 1);
    EXPECT_TRUE(std::ranges::any_of(rounded.report.warnings, [](const std::string& said) {
        return said.starts_with("Elevations are rounded to steps of 1 m");
    }));
}

TEST(SearchWarnings, ElevationsTakenAsHeights) {
    TownRun town;
    town.options.ground.mode = GroundMode::none;
    expect_warning(town, "-ground none takes elevations as heights above the ground, and their median is 10");
}

TEST(SearchWarnings, ATerrainModelTakenAsASurface) {
    TownRun town(MadeTown::terrain());
    expect_warning(town,
                   "No building was found: none of the cells of 'memory' rise by more than 2 m above their "
                   "surroundings, as in a terrain model (DTM)");
}

TEST(SearchWarnings, APicture) {
    TownRun town(MadeTown::terrain());
    town.dem.edit().bands = 3;
    town.dem.edit().bytes = true;
    expect_warning(town, "No building was found: 'memory' has 3 bands of byte values, like a picture");
    TownRun thesis(MadeTown::terrain());
    thesis.options.preset = Preset::thesis;
    thesis.options.filter.noise_factor = 100000;
    thesis.dem.edit().bytes = true;
    expect_warning(thesis, "No building was found: 'memory' has byte values, like a picture");
}

TEST(SearchWarnings, APictureIsNamedAlsoWhereItsColoursLookLikeBuildings) {
    TownRun town;
    town.dem.edit().bands = 4;
    town.dem.edit().bytes = true;
    expect_warning(town, "'memory' has 4 bands of byte values, like a picture");
    EXPECT_EQ(town.count(), 3U);
}

/// One band of bytes is elevations in whole metres, unless lights or shadows in it cannot be any.
TEST(SearchWarnings, AHillshadeIsNamedAlsoWhereItsShadesLookLikeBuildings) {
    TownRun bytes;
    bytes.dem.edit().bytes = true;
    bytes.run();
    EXPECT_EQ(bytes.count(), 3U);
    EXPECT_EQ(bytes.report.warnings, Texts{});
    TownRun lights(lit(MadeTown::surface(), 2));
    lights.dem.edit().bytes = true;
    lights.run();
    EXPECT_EQ(lights.count(), 3U);
    ASSERT_EQ(lights.report.warnings.size(), 2U);
    EXPECT_EQ(
        lights.report.warnings[1].find("'memory' has byte values, like a picture or a hillshade; give a "
                                       "surface model (DSM)"),
        0U)
        << lights.report.warnings[1];
    TownRun one(lit(MadeTown::surface(), 1));
    one.dem.edit().bytes = true;
    one.run();
    EXPECT_EQ(one.report.warnings.size(), 1U);  // about the cell
}

TEST(SearchWarnings, DegreesWithoutACrs) {
    TownRun town;
    town.dem.edit().transform = {13, 1e-5, 0, 52, 0, -1e-5};
    town.dem.edit().georeferenced = true;
    expect_warning(town, "No building was found: 'memory' has no CRS, and its coordinates look like degrees");
}

TEST(SearchWarnings, LessThanABuilding) {
    TownRun town;
    town.dem.edit().transform = {600000, 0.01, 0, 5800000, 0, -0.01};
    town.dem.edit().crs_wkt = Crs("EPSG:25832").wkt();
    expect_warning(town,
                   "No building was found: 'memory' covers 1.7 m x 1.4 m, which is less than a building");
}

TEST(SearchWarnings, WhatAccompaniesTheDemSaysNothing) {
    MemorySource nothing = MadeTown::source(MadeTown::in({}, 0, unknown));
    TownRun terrain;
    terrain.options.ground.mode = GroundMode::given;
    terrain.options.ground.terrain = "t.tif";
    terrain.terrain = &nothing;
    expect_warning(terrain, "No building was found: the terrain 't.tif' has no valid cell over the DEM");
    TownRun mask;
    mask.options.detect.mask = "m.tif";
    mask.mask = &nothing;
    expect_warning(mask, "No building was found: the mask 'm.tif' has no cell over the DEM");
    TownRun ndvi;
    ndvi.options.detect.ndvi = "n.tif";
    ndvi.ndvi = &nothing;
    expect_warning(ndvi, "The NDVI 'n.tif' has no valid cell over the DEM");
    EXPECT_EQ(ndvi.count(), 3U);
}

TEST(SearchWarnings, AValidCellWhereTheDemHasNoneIsNone) {
    std::vector<double> z = MadeTown::surface();
    std::vector<double> only = MadeTown::in({}, 0, unknown);
    z[MadeTown::index(5, 5)] = unknown;
    only[MadeTown::index(5, 5)] = 0.1;
    MemorySource source = MadeTown::source(only);
    TownRun town(z);
    town.ndvi = &source;
    expect_warning(town, "The NDVI '' has no valid cell over the DEM");
}

TEST(SearchWarnings, WhatOptionsLeaveOutIsCountedAndNamed) {
    TownRun area;
    area.options.filter.min_area_m2 = 500;
    area.run();
    EXPECT_EQ(area.count(), 1U);  // the podium; the two houses have 252 and 264 m2
    EXPECT_GE(area.report.counted(Reason::building_small), 2);
    TownRun all;
    all.options.filter.min_area_m2 = 1e300;
    expect_warning(all, "No building was found: -min_area ");
    EXPECT_EQ(all.count(), 0U);
    TownRun height;
    height.options.detect.min_height = 50;
    expect_warning(height, "No building was found: -min_height 50 leaves ");
    EXPECT_GE(height.report.counted(Reason::building_low), 3);
    TownRun sure;
    sure.options.detect.min_confidence = 1;
    expect_warning(sure, "No building was found: -min_confidence 1 leaves ");
    EXPECT_GE(sure.report.counted(Reason::building_doubtful), 3);
    sure.options.write.doubtful = true;  // they are in a layer of their own, but no buildings
    TownRun written;
    written.options = sure.options;
    expect_warning(written, "No building was found: -min_confidence 1 leaves ");
}

TEST(SearchWarnings, ABarePlaneHasNoBuilding) {
    for (const double slope : {0.45, 0.6, 1.0, 2.0})
        for (const double turn : {0.0, 0.5}) {
            std::vector<double> z;
            for (int r = 0; r < MadeTown::rows; ++r)
                for (int c = 0; c < MadeTown::cols; ++c)
                    z.push_back(100 + slope * (c * std::cos(turn) + r * std::sin(turn)));
            TownRun plane(z);
            plane.run();
            EXPECT_EQ(plane.count(), 0U) << slope << " " << turn;
            const Texts& warnings = plane.report.warnings;
            ASSERT_EQ(warnings.size(), 1U);
            EXPECT_TRUE(
                warnings[0].find(" of the cells of 'memory' rise by more than 2 m") != std::string::npos ||
                warnings[0].find(" % of the ground of 'memory' is steeper than 40 %") != std::string::npos)
                << warnings[0];
        }
}

TEST(SearchWarnings, OutlinesThatStayAsTraced) {
    TownRun coarse(MadeTown::slanted());
    coarse.dem.edit().transform = {600000, 2.5, 0, 5800000, 0, -2.5};
    coarse.dem.edit().crs_wkt = Crs("EPSG:25832").wkt();
    coarse.options.outline.wall_tolerance = 0.01;
    coarse.run();
    const Texts& warnings = coarse.report.warnings;
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find(" % of the length of the buildings' outlines keeps the staircase of the "
                               "cells, because walls cannot be seen in cells of 2.5 m"),
              std::string::npos)
        << warnings[0];
    double length = 0;
    for (std::size_t i = 0; i < coarse.count(); ++i)
        length += coarse.sink.number(buildings, i, "perim_m");
    EXPECT_NEAR(coarse.report.building_outlines.whole(), length, 0.005 * static_cast<double>(coarse.count()));
    EXPECT_GT(coarse.report.building_outlines.traced, 0.05 * length);
    TownRun off;
    off.dem.edit() = coarse.dem.info();
    off.options.outline.walls = Walls::off;
    off.run();
    EXPECT_EQ(off.report.warnings, Texts{});
    EXPECT_EQ(off.report.building_outlines.fitted, 0);
    EXPECT_GT(off.report.building_outlines.traced, 0);
    length = 0;
    for (std::size_t i = 0; i < off.sink.features[contours].size(); ++i)
        length += off.sink.number(contours, i, "perim_m");
    EXPECT_NEAR(off.report.contour_outlines.traced, length, 1e-9 * length);
}

}  // namespace
}  // namespace d2b::test

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "pipeline/made_town.hpp"

namespace d2b {
namespace {

using test::Box;
using test::buildings;
using test::contours;
using test::MadeTown;
using test::MemorySource;
using test::TownRun;

TEST(BuildingGrids, DegreesWithCellsThatAreNotSquare) {
    TownRun town;
    // At 60 degrees north a degree of longitude is half of one of latitude, so that cells are 1.1 m by 0.9 m.
    town.dem.edit().transform = {20, 2e-5, 0, 60, 0, -8e-6};
    town.dem.edit().crs_wkt = Crs("EPSG:4326").wkt();
    town.run();
    EXPECT_EQ(town.count(), 3U);
    const double degree = std::numbers::pi / 180;
    const double latitude = (60 - 70 * 8e-6) * degree;
    const double w = 1 - 0.00669437999014 * std::pow(std::sin(latitude), 2);
    const double meridian = 6378137 * (1 - 0.00669437999014) / std::pow(w, 1.5);
    const double parallel = 6378137 / std::sqrt(w) * std::cos(latitude);
    const double cell = 2e-5 * degree * parallel * 8e-6 * degree * meridian;
    for (const Box& box : {MadeTown::flat, MadeTown::gabled, MadeTown::podium}) {
        const std::size_t i = town.at(box, buildings, 0.95);
        EXPECT_NEAR(town.sink.number(buildings, i, "area_m2"), box.area() * cell, 0.04 * box.area() * cell);
    }
    EXPECT_EQ(town.report.units.areas, "geodesic");
}

TEST(BuildingGrids, Feet) {
    std::vector<double> z = MadeTown::surface();
    for (double& value : z)
        value /= 0.3048;
    TownRun town(std::move(z));
    town.dem.edit().band_unit = "ft";
    town.run();
    TownRun metres;
    metres.run();
    ASSERT_EQ(town.count(), metres.count());
    for (std::size_t i = 0; i < town.count(); ++i) {
        EXPECT_NEAR(town.sink.number(buildings, i, "height"), metres.sink.number(buildings, i, "height"),
                    1e-3);
        EXPECT_NEAR(town.sink.number(buildings, i, "ground") * 0.3048,
                    metres.sink.number(buildings, i, "ground"), 1e-3);
        EXPECT_NEAR(town.sink.number(buildings, i, "volume_m3"),
                    metres.sink.number(buildings, i, "volume_m3"), 1);
    }
    EXPECT_EQ(town.count(contours), metres.count(contours));  // tiers half a metre apart, not half a foot
    EXPECT_NEAR(town.report.stack_rmse_m, metres.report.stack_rmse_m, 1e-3);
    const std::size_t lawn = MadeTown::index(60, 10);
    EXPECT_NEAR(static_cast<double>(town.ground.values[lawn]), MadeTown::ground(60, 10), 0.1);  // metres
}

TEST(BuildingGrids, RowsThatRunNorth) {
    TownRun town;
    town.dem.edit().transform = {600000, 1, 0, 5800000, 0, 1};
    town.dem.edit().crs_wkt = Crs("EPSG:25832").wkt();
    town.run();
    EXPECT_EQ(town.count(), 3U);
    town.at(MadeTown::podium, buildings, 0.95);
}

TEST(BuildingGrids, Reprojected) {
    TownRun town;
    town.dem.edit().transform = {600000, 1, 0, 5800000, 0, -1};
    town.dem.edit().crs_wkt = Crs("EPSG:25832").wkt();
    town.options.outline.target_crs = "EPSG:4326";
    town.run();
    ASSERT_EQ(town.count(), 3U);
    for (const Feature& feature : town.sink.features[buildings])
        for (const Position& p : feature.parts[0].exterior) {
            EXPECT_NEAR(p.x, 10.48, 0.02);
            EXPECT_NEAR(p.y, 52.34, 0.02);
        }
    const double expected = MadeTown::flat.area() + MadeTown::gabled.area() + MadeTown::podium.area();
    double area = 0;
    for (std::size_t i = 0; i < 3; ++i)
        area += town.sink.number(buildings, i, "area_m2");
    EXPECT_NEAR(area, expected, 0.03 * expected);
}

/// A window's first row and column are not the raster's: labels and rasters follow it.
TEST(BuildingGrids, AWindowOfTheRaster) {
    TownRun town;
    const Window window{60, 15, 70, 80};  // around the podium
    town.dem.edit().window = window;
    town.run();
    EXPECT_EQ(town.count(), 1U);
    EXPECT_EQ(town.height.cells, 70 * 80);
    const std::size_t i = town.at(MadeTown::podium, buildings, 0.95);
    EXPECT_EQ(town.sink.whole(buildings, i, "at_edge"), 0);
    const std::size_t tower = 90 * 95 + 45;  // the raster in memory ends with the window's last column
    EXPECT_NEAR(static_cast<double>(town.height.values[tower]), MadeTown::tower_height, 0.4);
}

TEST(BuildingGrids, TracedThroughPointsTheyLoseHalfACell) {
    TownRun town;
    town.options.trace.mode = TraceMode::points;
    town.options.outline.walls = Walls::off;
    town.run();
    const std::size_t i = town.at(MadeTown::flat, buildings, 0.7);
    const double area = (MadeTown::flat.rows - 1) * (MadeTown::flat.cols - 1);
    EXPECT_NEAR(town.sink.number(buildings, i, "area_m2"), area, 0.03 * area);
    EXPECT_EQ(town.sink.value(buildings, i, "nodata"), FieldValue{});  // points are no cells
}

}  // namespace
}  // namespace d2b

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/crs.hpp"
#include "core/crs_cases.hpp"
#include "core/ellipsoid.hpp"

namespace d2b {
namespace {

using namespace test;

TEST(Geodesy, CellsBetweenParallels) {
    Geodesy geodesy{Crs("EPSG:4326")};
    EXPECT_TRUE(geodesy.geodesic());
    struct Cell {
        double south, north, width;
    };
    for (const Cell& c : {Cell{0, 1, 1}, Cell{60, 61, 1}, Cell{60, 65, 5}, Cell{-35.5, -35.25, 0.1},
                          Cell{60, 60.00009, 0.00018}, Cell{80, 80.0009, 0.005}, Cell{-20, 50, 120}}) {
        const Geodesy::Measure measure = geodesy.ring(rectangle(10, c.south, c.width, c.north - c.south));
        expect_near_relative(measure.area_m2, wgs84.cell(c.south, c.north, c.width), 1e-7);
        expect_near_relative(measure.perimeter_m,
                             wgs84.parallel(c.south, c.width) + wgs84.parallel(c.north, c.width) +
                                 2 * wgs84.meridian(c.south, c.north),
                             1e-7);
    }
}

TEST(Geodesy, OctantOfTheEarth) {
    // The earth has 510065621724088 m2, a quarter of a meridian 10001965.729 m, of the equator 10018754.171
    // m.
    const Geodesy::Measure measure =
        Geodesy{Crs("EPSG:4326")}.ring(WorldRing{{0, 0}, {90, 0}, {90, 90}, {0, 90}});
    EXPECT_NEAR(measure.area_m2, 510065621724088.44 / 8, 1);
    EXPECT_NEAR(measure.perimeter_m, 2 * 10001965.729 + 10018754.171, 0.01);
}

TEST(Geodesy, AroundAPole) {
    Geodesy geographic{Crs("EPSG:4326")};
    for (const double latitude : {89.0, 89.99, -85.0}) {
        const WorldRing around{{-180, latitude}, {-90, latitude}, {0, latitude}, {90, latitude}};
        const double cap = wgs84.cell(std::abs(latitude), 90, 360);
        expect_near_relative(geographic.ring(around).area_m2, cap, 1e-7);
        expect_near_relative(geographic.ring(around).perimeter_m, wgs84.parallel(latitude, 360), 1e-7);
    }
    // A circle of 89 degrees north in polar stereographic coordinates.
    std::vector<Position> circle;
    for (int i = 0; i < 20000; ++i)
        circle.push_back({i * 360.0 / 20000 - 180, 89});
    CoordinateTransform(Crs("EPSG:4326"), Crs("EPSG:3413"), {}).apply(circle);
    expect_near_relative(Geodesy{Crs("EPSG:3413")}.ring(circle).area_m2, wgs84.cell(89, 90, 360), 1e-7);
    // And a square about the pole, in one and in many pieces.
    Geodesy polar{Crs("EPSG:3413")};
    for (const double half : {10.0, 5000.0, 400000.0}) {
        const WorldRing square = rectangle(-half, -half, 2 * half, 2 * half);
        expect_near_relative(polar.ring(square).area_m2, polar.ring(densified(square, 5000)).area_m2, 1e-7);
    }
}

TEST(Geodesy, AcrossTheAntimeridian) {
    Geodesy geodesy{Crs("EPSG:4326")};
    const double cell = wgs84.cell(50, 50.5, 1);
    expect_near_relative(geodesy.ring(rectangle(179.5, 50, 1, 0.5)).area_m2, cell, 1e-7);
    expect_near_relative(geodesy.ring(rectangle(-180.5, 50, 1, 0.5)).area_m2, cell, 1e-7);
    expect_near_relative(geodesy.ring(rectangle(359.5, 50, 1, 0.5)).area_m2, cell, 1e-7);
    const WorldRing wrapped{{179.5, 50}, {-179.5, 50}, {-179.5, 50.5}, {179.5, 50.5}};
    expect_near_relative(geodesy.ring(wrapped).area_m2, cell, 1e-7);
    const WorldRing house{{179.9999, 50}, {-179.9999, 50}, {-179.9999, 50.0001}, {179.9999, 50.0001}};
    expect_near_relative(geodesy.ring(house).area_m2, wgs84.cell(50, 50.0001, 0.0002), 1e-7);
    // UTM zone 1 reaches over it.
    std::vector<Position> places{{180, 50}};
    CoordinateTransform(Crs("EPSG:4326"), Crs("EPSG:32601"), {}).apply(places);
    const double scale = utm_scale(places[0].x, 50);
    expect_near_relative(
        Geodesy{Crs("EPSG:32601")}.ring(rectangle(places[0].x - 10, places[0].y - 10, 20, 20)).area_m2,
        400 / (scale * scale), 1e-7);
}

TEST(Geodesy, SpheresAndRotatedPoles) {
    const double radius = 6371000;
    const auto cell = [&](double south, double north, double width) {
        return radius * radius * radians(width) * (std::sin(radians(north)) - std::sin(radians(south)));
    };
    expect_near_relative(Geodesy{Crs("+proj=longlat +R=6371000")}.ring(rectangle(5, 40, 2, 3)).area_m2,
                         cell(40, 43, 2), 1e-7);
    // Edges are cut in proportion to the radius, on earth or in a hand.
    expect_near_relative(Geodesy{Crs("+proj=eqc +R=1")}.ring(rectangle(0, 0, 1, 1)).area_m2, std::sin(1),
                         1e-7);
    // A turned sphere is the same sphere.
    const Crs rotated("+proj=ob_tran +o_proj=longlat +o_lon_p=0 +o_lat_p=39.25 +lon_0=18 +R=6371000");
    expect_near_relative(Geodesy{rotated}.ring(rectangle(5, 40, 2, 3)).area_m2, cell(40, 43, 2), 1e-7);
    // Equal area projections keep areas, at any size and whatever they do to edges.
    expect_near_relative(Geodesy{Crs("+proj=laea +lat_0=52 +lon_0=10 +R=6371000")}
                             .ring(WorldRing{{-2e6, 1e5}, {1e6, -1e6}, {1.5e6, 2e6}})
                             .area_m2,
                         (3e6 * 1.9e6 + 3.5e6 * 1.1e6) / 2, 1e-7);
}

TEST(Geodesy, NarrowRingsKeepTheirShare) {
    // A metre wide, 28 km long, one side in many pieces: a geodesic for the other side makes it ten times as
    // large.
    const double height = 0.00001;
    WorldRing strip{{10, 60 + height}};
    for (int i = 0; i <= 20000; ++i)
        strip.push_back({10 + 0.5 * i / 20000, 60});
    strip.push_back({10.5, 60 + height});
    expect_near_relative(Geodesy{Crs("EPSG:4326")}.ring(strip).area_m2, wgs84.cell(60, 60 + height, 0.5),
                         1e-7);
}

TEST(Geodesy, EdgesMayGoRoundTheWorld) {
    // Both ends of such an edge are the same place.
    const double half = 6378137 * std::numbers::pi;
    const double north = 6378137 * std::log(std::tan(radians(45 + 40 / 2.0)));
    expect_near_relative(Geodesy{Crs("EPSG:3857")}.ring(rectangle(-half, 0, 2 * half, north)).area_m2,
                         wgs84.cell(0, 40, 360), 1e-7);
}

}  // namespace
}  // namespace d2b

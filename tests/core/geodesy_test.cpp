#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/crs.hpp"
#include "core/crs_cases.hpp"
#include "core/ellipsoid.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

using namespace test;

TEST(Geodesy, PlanarWithoutCrs) {
    Geodesy geodesy{Crs()};
    const WorldRing triangle{{0, 0}, {4, 0}, {4, 3}};
    EXPECT_DOUBLE_EQ(geodesy.ring(triangle).area_m2, 6);
    EXPECT_DOUBLE_EQ(geodesy.ring(triangle).perimeter_m, 12);
    // A plain shoelace loses every digit of this area.
    EXPECT_DOUBLE_EQ(geodesy.ring(rectangle(1e9 + 0.5, -5e9, 0.25, 0.5)).area_m2, 0.125);
}

TEST(Geodesy, PlanarInLocalUnits) {
    Geodesy feet{Crs(local_feet)};
    EXPECT_DOUBLE_EQ(feet.ring(rectangle(10, 20, 100, 50)).area_m2, 5000 * 0.3048 * 0.3048);
    EXPECT_DOUBLE_EQ(feet.ring(rectangle(10, 20, 100, 50)).perimeter_m, 300 * 0.3048);
    EXPECT_DOUBLE_EQ(Geodesy{Crs(local_unknown)}.ring(rectangle(0, 0, 3, 2)).area_m2, 6);
    EXPECT_DOUBLE_EQ(Geodesy{Crs(unknown_projection)}.ring(rectangle(0, 0, 3, 2)).area_m2, 6);
}

TEST(Geodesy, FewPositionsHaveNoArea) {
    for (const char* text : {"", "EPSG:25832", "EPSG:4326"}) {
        Geodesy geodesy{Crs(text)};
        const WorldRing point{{9, 48}};
        EXPECT_EQ(geodesy.ring({}).area_m2, 0);
        EXPECT_EQ(geodesy.ring({}).perimeter_m, 0);
        EXPECT_EQ(geodesy.ring(point).perimeter_m, 0);
        EXPECT_EQ(geodesy.ring(WorldRing{{9, 48}, {9, 48}, {9, 48}}).perimeter_m, 0);
        const Geodesy::Measure there_and_back = geodesy.ring(WorldRing{{9, 48}, {9, 48.001}});
        EXPECT_NEAR(there_and_back.area_m2, 0, 1e-9);
        EXPECT_GT(there_and_back.perimeter_m, 0.0019);
    }
}

TEST(Geodesy, OrientationDoesNotMatter) {
    for (const char* text : {"", "EPSG:25832", "EPSG:4326"}) {
        Geodesy geodesy{Crs(text)};
        WorldRing ring{{9, 48}, {9.001, 48}, {9.002, 48.001}};
        const Geodesy::Measure measure = geodesy.ring(ring);
        EXPECT_GT(measure.area_m2, 0);
        std::reverse(ring.begin(), ring.end());
        expect_near_relative(geodesy.ring(ring).area_m2, measure.area_m2, 1e-8);
        expect_near_relative(geodesy.ring(ring).perimeter_m, measure.perimeter_m, 1e-9);
    }
}

TEST(Geodesy, PolygonIsExteriorLessInteriors) {
    WorldPolygon polygon{rectangle(0, 0, 10, 10), {rectangle(1, 1, 2, 3), rectangle(5, 5, 1, 1)}};
    std::reverse(polygon.interiors[0].begin(), polygon.interiors[0].end());
    Geodesy plane{Crs()};
    EXPECT_DOUBLE_EQ(plane.polygon(polygon).area_m2, 93);
    EXPECT_DOUBLE_EQ(plane.polygon(polygon).perimeter_m, 54);
    polygon.interiors.push_back(rectangle(0, 0, 20, 20));
    EXPECT_EQ(plane.polygon(polygon).area_m2, 0);
}

/// Ring as narrow as a hair and nearly half round the Earth: an error of 1e-7 of its area would take a vertex
/// every few centimetres. With as many as there may be it is a few metres wide on the mean.
TEST(Geodesy, CutsNoEdgeWithoutEnd) {
    Geodesy geodesy{Crs("EPSG:4326")};
    const WorldRing hair = rectangle(-85, 50, 170, 1e-9);
    const Geodesy::Measure measure = geodesy.ring(hair);
    EXPECT_NEAR(measure.perimeter_m, 2 * 170 * 71700, 2 * 170 * 100);  // 71.7 km a degree at 50 degrees
    EXPECT_LT(measure.area_m2, 10 * 170 * 71700);
}

TEST(Geodesy, DoesNotDependOnEarlierRings) {
    const WorldRing house = rectangle(755000.25, 5500000.5, 250, 310);
    Geodesy fresh{Crs("EPSG:25832")};
    Geodesy used{Crs("EPSG:25832")};
    for (int i = 0; i < 50; ++i)
        EXPECT_GT(used.ring(rectangle(300000 + 10000 * i, 5500000, 10.0 * (1 << (i % 12)), 40)).area_m2, 0);
    EXPECT_EQ(used.ring(house).area_m2, fresh.ring(house).area_m2);
    EXPECT_EQ(used.ring(house).perimeter_m, fresh.ring(house).perimeter_m);
}

TEST(Geodesy, NamesThePositionThatIsNowhere) {
    const auto message = [](const char* crs, const Position& position) {
        Geodesy geodesy{Crs(crs)};
        return error_of<InputError>([&] {
            static_cast<void>(geodesy.ring(WorldRing{{9, 48}, position, {9, 49}}));
        });
    };
    const std::string end =
        " has no longitude and latitude; check which coordinate reference system the coordinates are in.";
    EXPECT_EQ(message("EPSG:4326", {500000, 5300000}), "Position (500000, 5300000) of 'WGS 84'" + end);
    EXPECT_EQ(message("EPSG:4326", {9, 90.1}), "Position (9, 90.1) of 'WGS 84'" + end);
    EXPECT_EQ(message("EPSG:4326", {nan_value, 48}), "Position (nan, 48) of 'WGS 84'" + end);
    EXPECT_EQ(message("EPSG:25832", {9, nan_value}), "Position (9, nan) of 'ETRS89 / UTM zone 32N'" + end);
    EXPECT_EQ(message("EPSG:25832", {1e10, 0}), "Position (10000000000, 0) of 'ETRS89 / UTM zone 32N'" + end);
    EXPECT_EQ(message("EPSG:3857", {infinity, 0}), "Position (inf, 0) of 'WGS 84 / Pseudo-Mercator'" + end);
    EXPECT_EQ(message("EPSG:3857", {1e12, 0}), "Position (1e+12, 0) of 'WGS 84 / Pseudo-Mercator'" + end);
    EXPECT_EQ(message("", {9, nan_value}), "Position (9, nan) is not finite; check the georeferencing.");
    EXPECT_EQ(message("", {-infinity, 0}), "Position (-inf, 0) is not finite; check the georeferencing.");
}

TEST(Geodesy, OnesFromTheSameCrsWorkInThreads) {
    const Crs crs("EPSG:25832");
    std::array<Geodesy, 2> geodesies{Geodesy(crs), Geodesy(crs)};
    std::array<double, 2> areas{};
    const auto sum = [&](std::size_t i) {
        for (int n = 0; n < 2000; ++n)
            areas[i] += geodesies[i].ring(rectangle(600000 + n, 5500000, 20, 30)).area_m2;
    };
    std::thread other(sum, 1);
    sum(0);
    other.join();
    EXPECT_GT(areas[0], 0);
    EXPECT_EQ(areas[0], areas[1]);
}

TEST(Geodesy, CellsBetweenParallels) {
    Geodesy geodesy{Crs("EPSG:4326")};
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

double footpoint(double northing) {
    double low = 0;
    double high = 90;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (grs80.meridian(0, middle) < northing / 0.9996 ? low : high) = middle;
    }
    return low;
}

/// The integral of 1 / scale^2, by Simpson's rule both ways.
double utm_area(double x, double y, double width, double height) {
    constexpr int n = 20;
    const auto weight = [](int i) { return i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2; };
    double sum = 0;
    for (int row = 0; row <= n; ++row) {
        const double latitude = footpoint(y + height * row / n);
        for (int col = 0; col <= n; ++col)
            sum += weight(row) * weight(col) / std::pow(utm_scale(x + width * col / n, latitude), 2);
    }
    return sum * width * height / (9.0 * n * n);
}

TEST(Geodesy, UtmAtTheCentralMeridian) {
    Geodesy geodesy{Crs("EPSG:25832")};
    const Geodesy::Measure measure = geodesy.ring(rectangle(499990, 5300000, 20, 10));
    expect_near_relative(measure.area_m2, 200 / (0.9996 * 0.9996), 1e-9);
    expect_near_relative(measure.perimeter_m, 60 / 0.9996, 1e-9);
}

TEST(Geodesy, UtmAnywhereInItsZone) {
    Geodesy geodesy{Crs("EPSG:25832")};
    for (const double size : {1.0, 10.0, 100.0, 1000.0, 30000.0})
        for (const double east : {250000.0, 480000.0, 755000.0})
            expect_near_relative(geodesy.ring(rectangle(east, 5500000, size, size)).area_m2,
                                 utm_area(east, 5500000, size, size), 1e-7);
    for (const double east : {400000.0, 600000.0})
        expect_near_relative(geodesy.ring(rectangle(east, 5500000, 200000, 100000)).area_m2,
                             utm_area(east, 5500000, 200000, 100000), 1e-7);
}

/// Areas in many pieces, brought to longitude and latitude, where no piece is long enough to be cut.
TEST(Geodesy, AgreesWithBruteForce) {
    struct Case {
        const char* crs;
        WorldRing ring;
    };
    WorldRing decagon;
    for (int i = 0; i < 10; ++i)
        decagon.push_back({755000 + 8 * std::cos(i * std::numbers::pi / 5),
                           5.5e6 + 8 * std::sin(i * std::numbers::pi / 5)});
    const std::vector<Case> cases{{"EPSG:25832", rectangle(400000, 5500000, 200000, 100000)},
                                  {"EPSG:25832", rectangle(600000, 5500000, 200000, 100000)},
                                  {"EPSG:25832", decagon},
                                  {"EPSG:25832", {{755000, 5500000}, {755090, 5500040}, {754950, 5500130}}},
                                  {"EPSG:25832", {{300000, 5300000}, {700000, 5700000}, {650000, 5750000}}},
                                  {"EPSG:3857", {{0, 8000000}, {90000, 8001000}, {40000, 8070000}}},
                                  {"EPSG:3035", rectangle(3000000, 2000000, 1000000, 20000)},
                                  {"EPSG:27572", rectangle(600000, 2200000, 300, 50000)}};
    for (const Case& c : cases) {
        const Crs crs(c.crs);
        Geodesy geodesy{crs};
        const Geodesy::Measure measure = geodesy.ring(c.ring);
        const Geodesy::Measure pieces = geodesy.ring(densified(c.ring, 5000));
        expect_near_relative(measure.area_m2, pieces.area_m2, 1e-7);
        expect_near_relative(measure.perimeter_m, pieces.perimeter_m, 1e-7);
    }
    const Crs utm("EPSG:25832");
    for (const WorldRing& ring : {cases[0].ring, cases[1].ring, cases[2].ring}) {
        std::vector<Position> places = densified(ring, 5000);
        CoordinateTransform(utm, Crs("EPSG:4258"), {}).apply(places);
        expect_near_relative(Geodesy{utm}.ring(ring).area_m2, Geodesy{Crs("EPSG:4258")}.ring(places).area_m2,
                             1e-7);
    }
}

TEST(Geodesy, FeetAndGradsAreMetresAtLast) {
    // One place, in degrees and in the units of the CRS.
    const auto same = [](const char* text, const char* degrees, double x, double y) {
        WorldRing ring = rectangle(x, y, 100, 60);
        const double area = Geodesy{Crs(text)}.ring(ring).area_m2;
        CoordinateTransform(Crs(text), Crs(degrees), ring).apply(ring);
        expect_near_relative(area, Geodesy{Crs(degrees)}.ring(ring).area_m2, 1e-7);
        return area / 6000;
    };
    EXPECT_NEAR(same("EPSG:2253", "EPSG:4269", 13000000, 300000), 0.3048 * 0.3048, 2e-5);
    EXPECT_NEAR(same("EPSG:2227", "EPSG:4269", 6000000, 2100000), std::pow(1200.0 / 3937, 2), 2e-5);
    EXPECT_NEAR(same("EPSG:27572", "EPSG:4275", 600000, 2430000), 1, 1e-2);
    // Grads east of Paris on Clarke's ellipsoid of 1880.
    const Ellipsoid clarke{6378249.2, 1 - 6356515.0 / 6378249.2};
    expect_near_relative(Geodesy{Crs("EPSG:4807")}.ring(rectangle(1, 50, 0.1, 0.1)).area_m2,
                         clarke.cell(45, 45.09, 0.09), 1e-7);
}

}  // namespace
}  // namespace d2b

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/crs.hpp"
#include "core/crs_cases.hpp"
#include "core/ellipsoid.hpp"

namespace d2b {
namespace {

using namespace test;

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
    EXPECT_TRUE(geodesy.geodesic());
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

/// In many pieces, brought to longitude and latitude, where no piece is long enough to be cut.
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
    // One place, in degrees and in what the CRS has.
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

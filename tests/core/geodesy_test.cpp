#include <algorithm>
#include <array>
#include <cstddef>
#include <thread>

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
    EXPECT_FALSE(geodesy.geodesic());
    const WorldRing triangle{{0, 0}, {4, 0}, {4, 3}};
    EXPECT_DOUBLE_EQ(geodesy.ring(triangle).area_m2, 6);
    EXPECT_DOUBLE_EQ(geodesy.ring(triangle).perimeter_m, 12);
    // A plain shoelace loses every digit of this area.
    EXPECT_DOUBLE_EQ(geodesy.ring(rectangle(1e9 + 0.5, -5e9, 0.25, 0.5)).area_m2, 0.125);
}

TEST(Geodesy, PlanarInLocalUnits) {
    Geodesy feet{Crs(local_feet)};
    EXPECT_FALSE(feet.geodesic());
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

/// As narrow as a hair and nearly half round the Earth: an error of 1e-7 of its area would take a vertex
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
        return message_of<InputError>([&] {
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

}  // namespace
}  // namespace d2b

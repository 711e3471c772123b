#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/crs.hpp"
#include "core/crs_cases.hpp"
#include "core/ellipsoid.hpp"
#include "core/text.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

using namespace test;

TEST(CoordinateTransform, GoesThereAndBack) {
    const Crs utm("EPSG:25832");
    const std::vector<Position> places{{500000, 0}, {691608, 5334760}, {350000, 5650000}};
    for (const char* text : {"EPSG:3857", "EPSG:4326", "EPSG:28992+5709", "EPSG:4979"}) {
        const Crs other(text);
        std::vector<Position> moved = places;
        CoordinateTransform(utm, other, places).apply(moved);
        EXPECT_NE(moved, places);
        CoordinateTransform(other, utm, moved).apply(moved);
        for (std::size_t i = 0; i < places.size(); ++i) {
            // The way to the Dutch datum and back is exact to the square of its rotations.
            EXPECT_NEAR(moved[i].x, places[i].x, 1e-3) << text;
            EXPECT_NEAR(moved[i].y, places[i].y, 1e-3) << text;
        }
    }
}

TEST(CoordinateTransform, GivesGisOrder) {
    // On the central meridian, latitude is the length of the meridian arc.
    const double north = 0.9996 * grs80.meridian(0, 48);
    std::vector<Position> places{{500000, north}};
    CoordinateTransform(Crs("EPSG:25832"), Crs("EPSG:4326"), places).apply(places);
    EXPECT_NEAR(places[0].x, 9, 1e-9);
    EXPECT_NEAR(places[0].y, 48, 1e-9);
    CoordinateTransform(Crs("EPSG:4326"), Crs("EPSG:3857"), places).apply(places);
    EXPECT_NEAR(places[0].x, 6378137 * radians(9), 1e-3);
    EXPECT_NEAR(places[0].y, 6378137 * std::log(std::tan(radians(45 + 48 / 2.0))), 1e-3);
}

TEST(CoordinateTransform, KeepsTheShiftOfABoundCrs) {
    // One second of arc at the equator, as the shift along the y axis that TOWGS84 states.
    const double shift = 6378137 * std::tan(radians(1 / 3600.0));
    std::vector<Position> places{{0, 0}};
    CoordinateTransform(Crs("+proj=longlat +ellps=WGS84 +towgs84=0," + number_text(shift) + ",0"),
                        Crs("EPSG:4326"), {})
        .apply(places);
    EXPECT_NEAR(places[0].x * 3600, 1, 1e-6);
    EXPECT_NEAR(places[0].y, 0, 1e-9);
}

/// PROJ 9.1 calls itself without end where the area of interest begins or ends at 180 degrees.
TEST(CoordinateTransform, TakesAnAreaAtTheAntimeridian) {
    for (const std::vector<Position>& area : {std::vector<Position>{{180, -17}},
                                              {{-180, -17}},
                                              {{180, -17}, {180, -16.9}},
                                              {{180, -17}, {-180, -16.9}},
                                              {{-180, -90}, {180, 90}}})
        for (const char* target : {"EPSG:32660", "EPSG:3460"}) {
            std::vector<Position> places{{180, -17}};
            EXPECT_TRUE(CoordinateTransform(Crs("EPSG:4326"), Crs(target), area).try_apply(places));
        }
}

TEST(CoordinateTransform, SaysWhatHasNoImage) {
    std::vector<Position> places{{11, 48}, {11, 91}, {12, 48}};
    CoordinateTransform transform(Crs("EPSG:4326"), Crs("EPSG:25832"), {});
    EXPECT_FALSE(transform.try_apply(places));
    EXPECT_NEAR(places[0].y, 5317000, 2000);
    EXPECT_FALSE(std::isfinite(places[1].x));
    EXPECT_TRUE(std::isfinite(places[2].x));
    std::vector<Position> good{{11, 48}};
    EXPECT_TRUE(transform.try_apply(good));
    EXPECT_EQ(good[0], places[0]);
}

TEST(CoordinateTransform, TakesAnyArea) {
    const Crs geographic("EPSG:4326");
    const Crs fiji("EPSG:3460");
    const std::vector<Position> across{{179.9, -17}, {-179.9, -17}, {180.2, -16}};
    for (const std::vector<Position>& area :
         {across, std::vector<Position>{}, std::vector<Position>{{nan_value, 0}, {infinity, 1000}}}) {
        std::vector<Position> places{{179.9, -17}};
        CoordinateTransform(geographic, fiji, area).apply(places);
        EXPECT_NEAR(places[0].x, 2000000 + 0.99985 * wgs84.parallel(-17, 1.15), 200);
        EXPECT_NEAR(places[0].y, 4000000, 700);
    }
}

TEST(CoordinateTransform, PicksTheOperationForTheArea) {
    // The European datum of 1950 has parameters of its own in Norway, Spain, ...
    const Crs ed50("EPSG:23030");
    const auto moved = [&](const std::vector<Position>& area) {
        std::vector<Position> places{{400000, 4500000}};
        CoordinateTransform(ed50, Crs("EPSG:25830"), area).apply(places);
        return places[0];
    };
    const Position in_spain = moved({{390000, 4490000}, {410000, 4510000}});
    const Position in_norway = moved({{900000, 6650000}, {910000, 6660000}});
    EXPECT_GT(std::hypot(in_spain.x - in_norway.x, in_spain.y - in_norway.y), 1);
    EXPECT_NEAR(in_spain.x, 400000 - 109, 10);
    EXPECT_NEAR(in_spain.y, 4500000 - 207, 10);
}

TEST(CoordinateTransform, LeavesTheSameCrsAlone) {
    std::vector<Position> places{{0.1, 0.2}, {1e6, 2e6}};
    const std::vector<Position> before = places;
    for (const std::string& text : {std::string("EPSG:25832"), local_feet}) {
        CoordinateTransform same{Crs(text), Crs(text), places};
        same.apply(places);
        EXPECT_EQ(places, before);
        EXPECT_NO_THROW(same.apply({}));
    }
}

TEST(CoordinateTransform, NamesTheFirstPositionWithoutImageAndChangesNone) {
    const auto failure = [](CoordinateTransform& transform, std::vector<Position> places) {
        const std::vector<Position> before = places;
        const std::string message = message_of<InputError>([&] { transform.apply(places); });
        for (std::size_t i = 0; i < places.size(); ++i)
            EXPECT_TRUE(std::isnan(before[i].x) || places[i] == before[i]);
        return message;
    };
    const std::string end = "check which coordinate reference system the coordinates are in.";
    CoordinateTransform mercator(Crs("EPSG:4326"), Crs("EPSG:3857"), {});
    EXPECT_EQ(failure(mercator, {{1, 2}, {8, 5300000}, {nan_value, 3}}),
              "Position (8, 5300000) of 'WGS 84' has no image in 'WGS 84 / Pseudo-Mercator'; " + end);
    EXPECT_EQ(failure(mercator, {{1, 2}, {nan_value, 3}}),
              "Position (nan, 3) of 'WGS 84' has no image in 'WGS 84 / Pseudo-Mercator'; " + end);
    EXPECT_EQ(failure(mercator, {{1, -infinity}}),
              "Position (1, -inf) of 'WGS 84' has no image in 'WGS 84 / Pseudo-Mercator'; " + end);
    CoordinateTransform same(Crs("EPSG:4326"), Crs("EPSG:4326"), {});
    EXPECT_EQ(failure(same, {{infinity, 3}}),
              "Position (inf, 3) of 'WGS 84' has no image in 'WGS 84'; " + end);
}

TEST(CoordinateTransform, RefusesWhatCannotBe) {
    const Crs geographic("EPSG:4326");
    const auto message = [](const Crs& from, const Crs& to) {
        return message_of<OptionError>([&] { CoordinateTransform(from, to, {}); });
    };
    const std::string choose =
        "; choose a coordinate reference system that the coordinates can be converted to.";
    EXPECT_EQ(message(Crs(local_feet), geographic),
              "PROJ knows no operation from 'site grid' to 'WGS 84'" + choose);
    EXPECT_EQ(message(geographic, Crs(local_feet)),
              "PROJ knows no operation from 'WGS 84' to 'site grid'" + choose);
    EXPECT_EQ(message(Crs(unknown_projection), geographic),
              "PROJ knows no operation from 'odd' to 'WGS 84'" + choose);
    EXPECT_EQ(
        message(Crs(), geographic),
        "There is no coordinate reference system to transform from; state which one the coordinates are in.");
    EXPECT_EQ(
        message(geographic, Crs()),
        "There is no coordinate reference system to transform to; state which one the coordinates are in.");
    EXPECT_EQ(
        message(Crs("EPSG:4978"), geographic),
        "'WGS 84' has no plane coordinates to transform from; choose a projected or geographic coordinate "
        "reference system.");
    EXPECT_EQ(
        message(geographic, Crs("EPSG:5709")),
        "'NAP height' has no plane coordinates to transform to; choose a projected or geographic coordinate "
        "reference system.");
}

}  // namespace
}  // namespace d2b

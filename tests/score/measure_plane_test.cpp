#include <cmath>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "score/measure.hpp"
#include "score/shapes.hpp"
#include "support/error_of.hpp"

namespace d2b::score {
namespace {

using namespace test;

class MeasurePlaneTest : public testing::Test {
  protected:
    std::vector<std::string> heard_;
    Warnings warnings_{[this](const std::string& text) { heard_.push_back(text); }};
};

TEST(Measure, translatesAllRings) {
    Polygons polygons{{{{0, 0}, {10, 0}, {10, 10}}, {{{4, 4}, {6, 4}, {6, 6}}}}};
    translate(polygons, 1, -2);
    EXPECT_EQ(polygons[0].exterior[0], (Position{1, -2}));
    EXPECT_EQ(polygons[0].interiors[0][2], (Position{7, 4}));
}

TEST_F(MeasurePlaneTest, isAProjectedCrsWithItsUnit) {
    const MeasurePlane metres = measure_plane(Crs("EPSG:25832"), {0, 0, 1, 1}, warnings_);
    EXPECT_EQ(metres.metres, 1);
    EXPECT_EQ(metres.crs.name(), "ETRS89 / UTM zone 32N");
    EXPECT_FALSE(metres.local);
    EXPECT_EQ(measure_plane(Crs("EPSG:2253"), {0, 0, 1, 1}, warnings_).metres, 0.3048);
    EXPECT_TRUE(heard_.empty());
}

TEST_F(MeasurePlaneTest, takesPlainUnitsForMetres) {
    EXPECT_EQ(measure_plane(Crs(), {0, 0, 1, 1}, warnings_).metres, 1);
    ASSERT_EQ(heard_.size(), 1U);
    EXPECT_EQ(heard_[0], "Nothing has a coordinate reference system; units are taken as metres.");
}

TEST_F(MeasurePlaneTest, refusesGeocentricCoordinates) {
    EXPECT_EQ(error_of<InputError>([&] {
                  (void)measure_plane(Crs("EPSG:4978"), {0, 0, 1, 1}, warnings_);
              }),
              "'WGS 84' has no plane coordinates to measure in; reproject the reference first.");
}

TEST_F(MeasurePlaneTest, isLocalAboutDegrees) {
    const Crs degrees("EPSG:4326");
    const MeasurePlane plane = measure_plane(degrees, {8.99, 49.99, 9.01, 50.01}, warnings_);
    EXPECT_TRUE(plane.local);
    EXPECT_EQ(plane.metres, 1);
    // At 50 degrees north a second of latitude is 30.8970 m and one of longitude 19.9155 m on WGS 84.
    const double second = 1.0 / 3600;
    std::vector<Polygons> areas{{box(9, 50, 9 + second, 50 + second)}};
    transform_to(plane, degrees, "a", areas, LongEdges::keep, warnings_);
    EXPECT_NEAR(area_of(areas[0]), 30.8970 * 19.9155, 0.005);
    const Position corner = areas[0][0].exterior[0];
    EXPECT_NEAR(std::hypot(corner.x, corner.y), 0, 1e-6);
}

TEST_F(MeasurePlaneTest, dividesLongEdges) {
    const Crs degrees("EPSG:4326");
    const MeasurePlane plane = measure_plane(degrees, {8.9, 49.9, 9.1, 50.1}, warnings_);
    std::vector<Polygons> kept{{box(8.9, 49.9, 9.1, 50.1)}};
    std::vector<Polygons> divided = kept;
    transform_to(plane, degrees, "a", kept, LongEdges::keep, warnings_);
    transform_to(plane, degrees, "a", divided, LongEdges::divide, warnings_);
    EXPECT_EQ(vertex_count(kept[0], false), 4U);
    EXPECT_GT(vertex_count(divided[0], false), 150U);
    // The parallel through the lower corners runs below their chord: 14.4 km long, R = 6381 km on it, its
    // middle is length^2 / (8 R) tan(latitude) away.
    double lowest = 0;
    for (const Position& p : divided[0][0].exterior)
        lowest = std::min(lowest, p.y);
    EXPECT_NEAR(kept[0][0].exterior[0].y - lowest, 14374.0 * 14374 / 8 / 6381000 * std::tan(49.9 / 57.29578),
                0.05);
}

TEST_F(MeasurePlaneTest, leavesTheSameCrsAlone) {
    const MeasurePlane plane = measure_plane(Crs("EPSG:25832"), {}, warnings_);
    std::vector<Polygons> areas{{box(500000.1, 5800000.2, 500010.3, 5800010.4)}};
    transform_to(plane, Crs("EPSG:25832"), "a", areas, LongEdges::divide, warnings_);
    EXPECT_EQ(areas[0][0].exterior, box(500000.1, 5800000.2, 500010.3, 5800010.4).exterior);
    EXPECT_TRUE(heard_.empty());
}

TEST_F(MeasurePlaneTest, warnsWhereOneSideHasNoCrs) {
    std::vector<Polygons> areas{{box(0, 0, 1, 1)}};
    transform_to(measure_plane(Crs("EPSG:25832"), {}, warnings_), Crs(), "a.shp", areas, LongEdges::keep,
                 warnings_);
    transform_to({}, Crs("EPSG:25832"), "b.shp", areas, LongEdges::keep, warnings_);
    EXPECT_EQ(areas[0][0].exterior, box(0, 0, 1, 1).exterior);
    ASSERT_EQ(heard_.size(), 2U);
    EXPECT_EQ(heard_[0],
              "'a.shp' has no coordinate reference system and the other dataset has one; its coordinates "
              "are taken as they are.");
    EXPECT_EQ(heard_[1],
              "'b.shp' has a coordinate reference system and the other dataset has none; its coordinates "
              "are taken as they are.");
}

TEST_F(MeasurePlaneTest, takesNoAreas) {
    std::vector<Polygons> areas{{}};
    transform_to(measure_plane(Crs("EPSG:25832"), {}, warnings_), Crs("EPSG:4326"), "a", areas,
                 LongEdges::keep, warnings_);
    EXPECT_TRUE(areas[0].empty());
}

}  // namespace
}  // namespace d2b::score

#include "geometry/geos.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "support/box.hpp"

namespace d2b {
namespace {

using test::box;

FinePolygon lattice_box(std::int64_t row0, std::int64_t col0, std::int64_t row1, std::int64_t col1) {
    return {{{row0, col0}, {row1, col0}, {row1, col1}, {row0, col1}}, {}};
}

double area(const std::vector<WorldPolygon>& polygons) {
    double sum = 0;
    const auto add = [&](const WorldRing& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i)
            sum +=
                (ring[i].x * ring[(i + 1) % ring.size()].y - ring[(i + 1) % ring.size()].x * ring[i].y) / 2;
    };
    for (const WorldPolygon& polygon : polygons) {
        add(polygon.exterior);
        for (const WorldRing& ring : polygon.interiors)
            add(ring);
    }
    return sum;
}

double area(const std::vector<FinePolygon>& polygons) {
    std::vector<WorldPolygon> world;
    const auto convert = [](const FineRing& ring) {
        WorldRing result;
        for (const FinePoint p : ring)
            result.push_back({static_cast<double>(p.col), static_cast<double>(-p.row)});
        return result;
    };
    for (const FinePolygon& polygon : polygons) {
        world.push_back({convert(polygon.exterior), {}});
        for (const FineRing& ring : polygon.interiors)
            world.back().interiors.push_back(convert(ring));
    }
    return area(world);
}

TEST(Geos, ValidPolygonsHaveNoInvalidity) {
    Geos geos;
    EXPECT_EQ(geos.invalidity({box(0, 0, 1, 1)}), "");
    EXPECT_EQ(geos.invalidity({box(0, 0, 1, 1), box(1, 1, 2, 2)}), "");
    // A hole that touches the exterior ring in one point.
    WorldPolygon touching = box(0, 0, 4, 4);
    touching.interiors.push_back({{0, 2}, {1, 3}, {2, 2}, {1, 1}});
    EXPECT_EQ(geos.invalidity({touching}), "");
}

TEST(Geos, SaysWhatIsWrong) {
    Geos geos;
    const WorldPolygon bowtie{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}};
    EXPECT_EQ(geos.invalidity({bowtie}), "Self-intersection[1 1]");
    EXPECT_NE(geos.invalidity({box(0, 0, 2, 2), box(1, 0, 3, 2)}), "");
    EXPECT_EQ(geos.invalidity({box(0, 0, std::numeric_limits<double>::infinity(), 1)}),
              "a coordinate is not a finite number");
}

TEST(Geos, EmptyAndEndlessRingsAreInvalidAndNoException) {
    Geos geos;
    EXPECT_EQ(geos.invalidity({WorldPolygon{}}), "a ring has no points");
    WorldPolygon endless = box(0, 0, 9, 9);
    endless.interiors.push_back({{1, 1}, {1, std::numeric_limits<double>::quiet_NaN()}, {2, 1}});
    EXPECT_EQ(geos.invalidity({endless}), "a coordinate is not a finite number");
}

TEST(Geos, DifferenceOfCrossingOutlinesIsRefused) {
    Geos geos;
    // The two diagonals cross at (1.5, -1.5).
    const FinePolygon whole{{{0, 0}, {3, 3}, {0, 3}}, {}};
    const FinePolygon part{{{3, 0}, {3, 1}, {0, 3}}, {}};
    EXPECT_THROW(static_cast<void>(geos.difference(whole, {part})), Error);
}

TEST(Geos, ARingOfTooFewPointsIsInvalidAndNoException) {
    Geos geos;
    EXPECT_NE(geos.invalidity({WorldPolygon{{{0, 0}, {1, 1}}, {}}}), "");
}

TEST(Geos, RepairsToValidOrientedPolygons) {
    Geos geos;
    const WorldPolygon bowtie{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}};
    const auto repaired = geos.repaired({bowtie});
    EXPECT_EQ(repaired.size(), 2U);
    EXPECT_EQ(geos.invalidity(repaired), "");
    EXPECT_DOUBLE_EQ(area(repaired), 2);  // counter-clockwise, or it would be negative
}

TEST(Geos, DifferenceIsExactOnTheLattice) {
    Geos geos;
    const FinePolygon whole = lattice_box(0, 0, 10, 10);
    // One child shares a wall and two corners, one stands free, and both touch in a corner.
    const auto left =
        geos.difference(whole, {lattice_box(0, 0, 4, 10), lattice_box(6, 2, 8, 5), lattice_box(4, 0, 5, 1)});
    EXPECT_EQ(area(left), 100 - 40 - 6 - 1);
    ASSERT_EQ(left.size(), 1U);
    EXPECT_EQ(left[0].interiors.size(), 1U);
}

TEST(Geos, DifferenceMayComeApartOrVanish) {
    Geos geos;
    EXPECT_EQ(geos.difference(lattice_box(0, 0, 3, 9), {lattice_box(0, 3, 3, 6)}).size(), 2U);
    EXPECT_TRUE(geos.difference(lattice_box(0, 0, 3, 3), {lattice_box(0, 0, 3, 3)}).empty());
    EXPECT_EQ(geos.difference(lattice_box(0, 0, 3, 3), {}).front().exterior,
              lattice_box(0, 0, 3, 3).exterior);
}

TEST(Geos, ReportsItsVersion) {
    EXPECT_EQ(geos_version().find_first_not_of("0123456789."), std::string::npos);
}

}  // namespace
}  // namespace d2b

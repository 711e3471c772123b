#include "features/rounded_polygons.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "support/error_of.hpp"

namespace d2b::features {
namespace {

using Parts = std::vector<WorldPolygon>;
using To = CoordinateRounding::To;

const CoordinateRounding whole{To::decimals, 0, "-lco COORDINATE_PRECISION=0"};

std::string refusal(RoundedPolygons& polygons) {
    return test::error_of<OptionError>([&] { polygons.finish(); });
}

TEST(RoundedCoordinate, IsTheDecimalFractionThatIsReadBack) {
    const auto decimals = [](double value, int digits) { return rounded(value, {To::decimals, digits}); };
    EXPECT_EQ(decimals(391000.46875, 2), 391000.47);
    EXPECT_EQ(decimals(-0.00049, 3), 0.0);
    EXPECT_EQ(decimals(13.3977216549, 7), 13.3977217);
    EXPECT_EQ(decimals(0.1 + 0.2, 17), 0.1 + 0.2);
    EXPECT_EQ(decimals(5820123.4567891234, 15), 5820123.4567891234);
    const auto figures = [](double value, int digits) {
        return rounded(value, {To::significant_digits, digits});
    };
    EXPECT_EQ(figures(391000.46875, 8), 391000.47);
    EXPECT_EQ(figures(5820123.456, 3), 5820000.0);
    EXPECT_EQ(figures(0.00123456, 3), 0.00123);
    EXPECT_EQ(figures(0, 3), 0.0);
    EXPECT_EQ(rounded(1.23456, {}), 1.23456);
}

TEST(RoundedPolygons, AreOnTheGridOfTheDestination) {
    RoundedPolygons polygons({To::decimals, 1, "x"}, true, {});
    Parts parts{{{{0.04, 0}, {2.06, 0.02}, {2, 2}, {0.04, 2.04}}, {}}};
    EXPECT_FALSE(polygons.round(LayerRole::buildings, 0, "building 1", parts));
    EXPECT_EQ(parts.at(0).exterior, (WorldRing{{0, 0}, {2.1, 0}, {2, 2}, {0, 2}}));
    EXPECT_EQ(refusal(polygons), "(no error)");
}

TEST(RoundedPolygons, WhatIsLostIsRefusedWithTheCoarsestPrecisionThatKeepsAll) {
    RoundedPolygons polygons(whole, true, {});
    Parts large{{{{0, 0}, {7, 0}, {7, 7.4}, {0, 7.4}}, {}}};
    polygons.round(LayerRole::buildings, 0, "building 1", large);
    Parts small{{{{9.1, 9.1}, {9.14, 9.1}, {9.14, 9.14}, {9.1, 9.14}}, {}}};
    polygons.round(LayerRole::buildings, 0, "building 2", small);
    EXPECT_EQ(refusal(polygons),
              "-lco COORDINATE_PRECISION=0 rounds coordinates so much that a polygon is lost or runs into "
              "another: building 2; the coarsest precision that keeps all is 2 decimals.");
}

/// The hypotenuse of the parent sinks from 4.7 to 4.5 above x = 5, where a corner of the child rises from 4.6
/// to 5.
TEST(RoundedPolygons, AContourMayLeaveItsParentByTheRounding) {
    RoundedPolygons polygons(whole, true, {});
    Parts parts{{{{0, 0}, {10, 0}, {10, 9.4}}, {}}};
    polygons.round(LayerRole::contours, 0, "contour 1", parts);
    parts = {{{{4, 1}, {6, 1}, {5, 4.6}}, {}}};
    polygons.round(LayerRole::contours, 1, "contour 2", parts);
    EXPECT_EQ(refusal(polygons), "(no error)");
}

/// The hypotenuse rises from 6 to 6.4 at x = 8, where a corner of the other building sinks from 6.2 to 6.
TEST(RoundedPolygons, BuildingsThatRunIntoEachOtherAreRefused) {
    RoundedPolygons polygons(whole, true, {});
    Parts below{{{{0, 0}, {10, 0}, {10, 7.5}}, {}}};
    polygons.round(LayerRole::buildings, 0, "building 1", below);
    Parts above{{{{7, 9}, {8, 6.2}, {9, 9}}, {}}};
    polygons.round(LayerRole::buildings, 0, "building 2", above);
    EXPECT_EQ(refusal(polygons),
              "-lco COORDINATE_PRECISION=0 rounds coordinates so much that a polygon is lost or runs into "
              "another: building 1; the coarsest precision that keeps all is 1 decimal.");
}

/// The notch comes down to the edge below it: two polygons that touch are left of one.
TEST(RoundedPolygons, WhatIsBrokenIsMendedOnTheGrid) {
    RoundedPolygons polygons(whole, true, {});
    Parts parts{{{{0, 0}, {10, 1.6}, {10, 10}, {5, 0.9}, {0, 10}}, {}}};
    EXPECT_TRUE(polygons.round(LayerRole::buildings, 0, "building 1", parts));
    EXPECT_EQ(Geos().invalidity(parts), "");
    EXPECT_EQ(parts.size(), 2U);
    for (const WorldPolygon& part : parts)
        for (const Position& p : part.exterior) {
            EXPECT_EQ(p.x, std::round(p.x));
            EXPECT_EQ(p.y, std::round(p.y));
        }
    EXPECT_EQ(refusal(polygons), "(no error)");
}

TEST(RoundedPolygons, WhereNoPrecisionHelpsAnotherFormatDoes) {
    RoundedPolygons polygons({To::significant_digits, 1, "The format X"}, true, {});
    Parts parts{{{{1.5, 1.5}, {1.5, 1.5}, {1.5, 1.5}}, {}}};
    polygons.round(LayerRole::buildings, 0, "building 1", parts);
    EXPECT_EQ(refusal(polygons),
              "The format X rounds coordinates so much that a polygon is lost or runs into another: building "
              "1; write another format, such as GeoPackage.");
}

}  // namespace
}  // namespace d2b::features

#include "score/shape.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "score/shapes.hpp"

namespace d2b::score {
namespace {

using namespace test;

/// The ring turned counter-clockwise around the origin.
WorldRing turned(const WorldRing& ring, double degrees) {
    const double cosine = std::cos(degrees * std::numbers::pi / 180);
    const double sine = std::sin(degrees * std::numbers::pi / 180);
    WorldRing result;
    for (const Position& p : ring)
        result.push_back({cosine * p.x - sine * p.y, sine * p.x + cosine * p.y});
    return result;
}

ShapeScore shape_of(const CornerRings& polygon, std::optional<double> short_edge = {}) {
    ShapeLimits limits;
    limits.short_edge = short_edge;
    return measure_shape(std::span(&polygon, 1), limits);
}

const WorldRing rectangle{{0, 0}, {20, 0}, {20, 10}, {0, 10}};

TEST(Shape, ofARectangleTurnedBy20Degrees) {
    const ShapeScore shape = shape_of({turned(rectangle, 20)}, 12);
    EXPECT_EQ(shape.polygons, 1U);
    EXPECT_EQ(shape.corners, 4U);
    EXPECT_EQ(shape.corners_per_building, 4);
    EXPECT_EQ(shape.right_share, 1);
    EXPECT_EQ(shape.sharp45_share, 0);
    EXPECT_NEAR(shape.along_share, 1, 1e-12);
    EXPECT_EQ(shape.short_edge_share, 0.5);  // the two of 10 m
    EXPECT_FALSE(shape_of({rectangle}).short_edge_share);
}

TEST(Shape, ofAnLWithACutCorner) {
    // Five corners of 90 or 270 degrees and two of 135. The cut is 3 * sqrt(2) long, the others 74 m
    // together.
    const WorldRing l{{0, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 20}, {3, 20}, {0, 17}};
    const ShapeScore shape = shape_of({turned(l, 50)}, 5);
    EXPECT_EQ(shape.corners, 7U);
    EXPECT_DOUBLE_EQ(shape.right_share, 5.0 / 7);
    EXPECT_EQ(shape.sharp45_share, 0);
    EXPECT_NEAR(shape.along_share, 74 / (74 + 3 * std::sqrt(2)), 1e-12);
    EXPECT_DOUBLE_EQ(shape.short_edge_share.value(), 1.0 / 7);  // the cut
    EXPECT_NEAR(main_direction({turned(l, 50)}, 3).degrees, 50, 1e-9);
}

TEST(Shape, ofATriangle) {
    // Its angles are 26.6, 90 and 63.4 degrees; the hypotenuse is 10 * sqrt(5) long.
    const ShapeScore shape = shape_of({{{0, 0}, {20, 0}, {20, 10}}});
    EXPECT_EQ(shape.corners, 3U);
    EXPECT_DOUBLE_EQ(shape.right_share, 1.0 / 3);
    EXPECT_DOUBLE_EQ(shape.sharp45_share, 1.0 / 3);
    EXPECT_NEAR(shape.along_share, 30 / (30 + 10 * std::sqrt(5)), 1e-12);
}

TEST(Shape, doesNotCallLimitsSharpOrShort) {
    const ShapeScore shape = shape_of({turned({{0, 0}, {10, 0}, {10, 10}}, 7)}, 10);
    EXPECT_EQ(shape.sharp45_share, 0);  // two of exactly 45 degrees
    EXPECT_EQ(shape.short_edge_share, 0);
}

TEST(Shape, seesSharpNotches) {
    // A square with a notch 2 m wide and 8 m deep: 14.3 of 180 degrees outside, at its end.
    const WorldRing notched{{0, 0}, {20, 0}, {20, 20}, {11, 20}, {10, 12}, {9, 20}, {0, 20}};
    EXPECT_DOUBLE_EQ(shape_of({notched}).sharp45_share, 1.0 / 7);
    const WorldRing clockwise(notched.rbegin(), notched.rend());
    EXPECT_DOUBLE_EQ(shape_of({clockwise}).sharp45_share, 1.0 / 7);
}

TEST(Shape, bearsThreeDegrees) {
    // The upper wall rises by 2.86 degrees, then by 3.43.
    EXPECT_EQ(shape_of({{{0, 0}, {20, 0}, {20, 11}, {0, 10}}}).right_share, 1);
    const ShapeScore steeper = shape_of({{{0, 0}, {20, 0}, {20, 11.2}, {0, 10}}});
    EXPECT_EQ(steeper.right_share, 0.5);
    const double upper = std::hypot(20, 1.2);
    EXPECT_NEAR(steeper.along_share, (20 + 11.2 + 10) / (20 + 11.2 + 10 + upper), 1e-12);
}

TEST(Shape, countsCourtyardsAndAllPolygons) {
    const CornerRings with_court{rectangle, turned({{4, 4}, {4, 6}, {8, 6}, {8, 4}}, 30)};
    // The court's four edges, 12 m of 72, lie across the main direction of the walls outside.
    EXPECT_NEAR(shape_of(with_court).along_share, 60.0 / 72, 1e-12);
    const ShapeScore both =
        measure_shape(std::vector<CornerRings>{with_court, {{{0, 0}, {20, 0}, {20, 10}}}}, {});
    EXPECT_EQ(both.polygons, 2U);
    EXPECT_EQ(both.corners_per_building, 11.0 / 2);
    EXPECT_DOUBLE_EQ(both.right_share, 9.0 / 11);
    EXPECT_NEAR(both.along_share, (60 + 30) / (72 + 30 + 10 * std::sqrt(5)), 1e-12);
}

TEST(Shape, ofNothingIsZero) {
    ShapeLimits limits;
    limits.short_edge = 1;
    const ShapeScore nothing = measure_shape({}, limits);
    EXPECT_EQ(nothing.corners_per_building, 0);
    EXPECT_EQ(nothing.right_share, 0);
    EXPECT_EQ(nothing.along_share, 0);
    EXPECT_EQ(nothing.short_edge_share, 0);
}

TEST(MainDirection, isModulo90) {
    for (const double degrees : {0.0, 20.0, 89.9})
        for (const double quarters : {0.0, 90.0, 180.0, -90.0}) {
            const MainDirection direction = main_direction({turned(rectangle, degrees + quarters)}, 3);
            EXPECT_NEAR(angle_between(direction.degrees, degrees), 0, 1e-9);
            EXPECT_GE(direction.degrees, 0);
            EXPECT_LT(direction.degrees, 90);
            EXPECT_NEAR(direction.along, 60, 1e-9);
            EXPECT_NEAR(direction.length, 60, 1e-9);
        }
}

TEST(MainDirection, isThatOfTheLongestOfEqualEdges) {
    // All four edges are within 3 degrees of each other, modulo 90; the longest is the one at 0.57 degrees.
    const WorldRing skew{{0, 0}, {20, 0.2}, {20, 10}, {0.1, 10}};
    EXPECT_NEAR(main_direction({skew}, 3).degrees, std::atan(0.01) * 180 / std::numbers::pi, 1e-9);
}

TEST(AngleBetween, isModulo90) {
    EXPECT_DOUBLE_EQ(angle_between(10, 30), 20);
    EXPECT_DOUBLE_EQ(angle_between(89, 2), 3);
    EXPECT_DOUBLE_EQ(angle_between(0, 45), 45);
}

TEST(DirectionErrors, areInterpolated) {
    const DirectionErrors errors = direction_errors({10, 1, 3, 2}).value();
    EXPECT_EQ(errors.pairs, 4U);
    EXPECT_DOUBLE_EQ(errors.median_deg, 2.5);
    EXPECT_DOUBLE_EQ(errors.p90_deg, 3 + 0.7 * 7);
    EXPECT_EQ(direction_errors({7}).value().p90_deg, 7);
    EXPECT_FALSE(direction_errors({}));
}

TEST(FromLeftmost, beginsAtTheLowestOfTheLeft) {
    EXPECT_EQ(from_leftmost({{5, 0}, {5, 5}, {0, 5}, {0, 0}}), (WorldRing{{0, 0}, {5, 0}, {5, 5}, {0, 5}}));
}

TEST(ScoreShape, leavesOutVerticesOnWalls) {
    // The first vertex of the ring and one more are 4 cm from a wall of 10 m.
    const WorldPolygon wavy{{{5, 0.04}, {10, 0}, {10, 10}, {5, 9.96}, {0, 10}, {0, 0}}, {}};
    const Score result = score(side({wavy}), side({box(0, 0, 10, 10)}), {});
    EXPECT_EQ(result.found.shape.corners, 4U);
    EXPECT_EQ(result.found.shape.right_share, 1);
    EXPECT_EQ(result.reference.shape.corners, 4U);
    ScoreOptions in_feet;
    in_feet.metres = 0.3048;  // 0.2 ft are 6 cm, 0.04 ft are not
    const WorldPolygon bent{{{0, 0}, {5, 0.2}, {10, 0}, {10, 10}, {5, 9.96}, {0, 10}}, {}};
    EXPECT_EQ(score(side({bent}), side({bent}), in_feet).found.shape.corners, 5U);
    EXPECT_EQ(score(side({bent}), side({bent}), {}).found.shape.corners, 5U);
    in_feet.metres = 0.2;  // 4 cm
    EXPECT_EQ(score(side({bent}), side({bent}), in_feet).found.shape.corners, 4U);
}

TEST(ScoreShape, countsEdgesBelowTwoCells) {
    ScoreOptions options;
    options.cell_m = 5;
    const auto short_edges = [&] {
        const ShapeScore shape =
            score(side({box(0, 0, 20, 9)}), side({box(0, 0, 20, 10)}), options).found.shape;
        return shape.short_edge_share;
    };
    EXPECT_EQ(short_edges(), 0.5);
    options.cell_m = 4.5;
    EXPECT_EQ(short_edges(), 0);
    options.metres = 0.3048;  // 20 by 9 ft are 6.1 by 2.7 m
    EXPECT_EQ(short_edges(), 1);
    options.cell_m = {};
    EXPECT_FALSE(short_edges());
}

TEST(ScoreShape, takesPolygonsThatTouchTheRegionAsTheyAre) {
    ScoreOptions options;
    options.region = Polygons{box(0, 0, 10, 20)};
    const WorldPolygon triangle{{{8, 0}, {28, 0}, {28, 10}}, {}};  // reaches out of the region
    const Score result =
        score(side({triangle, box(40, 0, 50, 10)}), side({box(10, 0, 20, 10), box(30, 0, 40, 10)}), options);
    EXPECT_EQ(result.found.shape.polygons, 1U);
    EXPECT_EQ(result.found.shape.corners, 3U);
    EXPECT_EQ(result.reference.shape.polygons, 1U);  // touches its border
}

TEST(ScoreShape, comparesDirectionsOfPairs) {
    const auto square_at = [](double x, double y, double side_length, double degrees) {
        const double half = side_length / 2;
        WorldRing ring = turned({{-half, -half}, {half, -half}, {half, half}, {-half, half}}, degrees);
        for (Position& p : ring)
            p = {p.x + x, p.y + y};
        return WorldPolygon{ring, {}};
    };
    // 10, 88 (so 2 from 90) and 3 degrees off; the fourth pair is too large, the fifth too far apart.
    const auto found = side({square_at(0, 0, 10, 30), square_at(50, 0, 10, 88), square_at(100, 0, 15, 3),
                             square_at(200, 0, 21, 30), square_at(300, 0, 10, 40)});
    const auto reference = side({square_at(0, 0, 10, 20), square_at(50, 0, 10, 0), square_at(100, 0, 15, 0),
                                 square_at(200, 0, 21, 0), square_at(307, 0, 10, 0)});
    const DirectionErrors errors = score(found, reference, {}).directions.value();
    EXPECT_EQ(errors.pairs, 3U);
    EXPECT_NEAR(errors.median_deg, 3, 1e-9);
    EXPECT_NEAR(errors.p90_deg, 3 + 0.8 * 7, 1e-9);
    ScoreOptions in_feet;
    in_feet.metres = 0.3048;  // 21 ft by 21 ft are 41 m2
    EXPECT_EQ(score(found, reference, in_feet).directions.value().pairs, 4U);
    EXPECT_FALSE(score(found, side({}), {}).directions);
}

TEST(ScoreShape, takesDirectionsOfWallsAndNotOfCuts) {
    ScoreOptions options;
    // Of the long house a slice of 2 m remains, whose cuts are its longest edges, at 27 degrees.
    options.region = Polygons{{{{4, 0}, {6, 0}, {16, 20}, {14, 20}}, {}}};
    const WorldPolygon house = box(0, 5, 30, 10);
    const DirectionErrors errors =
        score(side({house}), side({{turned({{0, 5}, {30, 5}, {30, 10}, {0, 10}}, 4), {}}}), options)
            .directions.value();
    EXPECT_EQ(errors.pairs, 1U);
    EXPECT_NEAR(errors.median_deg, 4, 1e-9);
}

}  // namespace
}  // namespace d2b::score

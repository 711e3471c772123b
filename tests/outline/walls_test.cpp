#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/geos.hpp"
#include "outline/outline.hpp"
#include "outline/walls/wall_directions.hpp"
#include "support/outline_checks.hpp"
#include "support/trace_grid.hpp"

namespace d2b::outline {
namespace {

using test::planar_area;
using test::trace_grid;
using test::TraceGrid;
using test::unit_grid;

struct Place {
    double x;
    double y;
};
using Shape = std::function<int(Place)>;

/// A grid of labels: those of a shape at the centres of cells; 0 is outside.
TraceGrid paint(std::int32_t size, const Shape& shape) {
    TraceGrid grid{size, size, {}, {}};
    for (std::int32_t row = 0; row < size; ++row)
        for (std::int32_t col = 0; col < size; ++col) {
            const int label = shape({col + 0.5, -(row + 0.5)});
            grid.z.push_back(label > 0 ? 20 : 0);
            grid.labels.push_back(static_cast<Label>(label));
        }
    return grid;
}

/// Whether a place lies in a rectangle about a centre that is turned counter-clockwise.
bool in_box(Place p, Place centre, double angle, double length, double width) {
    const double u = (p.x - centre.x) * std::cos(angle) + (p.y - centre.y) * std::sin(angle);
    const double v = (p.y - centre.y) * std::cos(angle) - (p.x - centre.x) * std::sin(angle);
    return std::abs(u) <= length / 2 && std::abs(v) <= width / 2;
}

OutlineRules walls(Walls style = Walls::automatic, double tolerance = 1.5) {
    OutlineRules rules;
    rules.walls = style;
    rules.wall_tolerance = tolerance;
    return rules;
}

struct Drawn {
    explicit Drawn(const TraceGrid& grid, const OutlineRules& rules = walls(),
                   const std::vector<double>& levels = {10})
        : set(trace_grid(grid, levels, {}, context)),
          outliner(*set.list, OutlineMethod::regularized, rules, unit_grid, 1, context) {}
    Context context;
    test::ContourSet set;
    Outliner outliner;

    [[nodiscard]] std::vector<Position> exterior(std::size_t contour) const {
        return unit_grid.polygon(outliner.footprint(contour)).exterior;
    }
};

class TurnedRectangle : public testing::TestWithParam<int> {};

TEST_P(TurnedRectangle, RecoversItsFourCorners) {
    const double angle = GetParam() * std::numbers::pi / 180;
    const Place centre{40.3, -39.6};
    const Drawn drawn(paint(80, [&](Place p) { return in_box(p, centre, angle, 44, 24) ? 1 : 0; }));
    const auto ring = drawn.exterior(1);
    ASSERT_EQ(ring.size(), 4U);
    for (const Position corner : ring) {
        double nearest = 1e9;
        for (const double u : {-22.0, 22.0})
            for (const double v : {-12.0, 12.0})
                nearest = std::min(
                    nearest, std::hypot(corner.x - centre.x - u * std::cos(angle) + v * std::sin(angle),
                                        corner.y - centre.y - u * std::sin(angle) - v * std::cos(angle)));
        EXPECT_LT(nearest, 1);
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const Position a = ring[i];
        const Position b = ring[(i + 1) % 4];
        const double off = (std::atan2(b.y - a.y, b.x - a.x) - angle) / (std::numbers::pi / 2);
        EXPECT_LT(std::abs(off - std::round(off)) * 90, 1) << "degrees";
    }
    EXPECT_NEAR(planar_area(drawn.outliner.outline(1)), 44 * 24, 0.02 * 44 * 24);
    EXPECT_EQ(drawn.outliner.quality(1).status, OutlineStatus::regularized);
    EXPECT_LE(drawn.outliner.quality(1).deviation_cells, 1.5);
    EXPECT_LE(std::abs(drawn.outliner.quality(1).area_change), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Degrees, TurnedRectangle, testing::Values(0, 3, 11, 20, 30, 37, 45, 58, 71, 85));

TEST(Walls, FollowWhatIsWorthTheirPrice) {
    // A porch of nine cells takes four more walls.
    const TraceGrid house = paint(40, [](Place p) {
        return in_box(p, {20, -20}, 0, 10, 10) || in_box(p, {20, -13.5}, 0, 3, 3) ? 1 : 0;
    });
    OutlineRules rules = walls(Walls::automatic, 3);
    EXPECT_EQ(Drawn(house, rules).exterior(1).size(), 8U);
    rules.wall_price = 4;
    EXPECT_EQ(Drawn(house, rules).exterior(1).size(), 4U);
}

/// A frame takes two walls; one alone is a direction of its own, in which nothing else runs.
TEST(WallDirections, OneWallIsNotAFrame) {
    const auto stretch = [](double length, double degrees) { return Stretch{length, degrees * degree}; };
    std::vector<Stretch> house{stretch(20, 3), stretch(10, 93), stretch(20, 183), stretch(10, -87),
                               stretch(12, 40)};
    const auto frames = [&] {
        DirectionHistogram histogram;
        DirectionHistogram::add(house, {&histogram});
        return histogram.frames(4);
    };
    ASSERT_EQ(frames().size(), 1U);
    EXPECT_NEAR(frames()[0], 3 * degree, 0.5 * degree);
    const std::vector<double> single = single_directions(house, frames(), 6, 3);
    ASSERT_EQ(single.size(), 1U);
    EXPECT_NEAR(single[0], 40 * degree, 1e-9);
    house.push_back(stretch(4, 130));  // too short for a wall
    EXPECT_EQ(frames().size(), 1U);
    house.push_back(stretch(6, 130));
    ASSERT_EQ(frames().size(), 2U);
    EXPECT_NEAR(frames()[1], 40 * degree, 0.5 * degree);
}

/// A place in the frame of a building: along its main direction and across it.
Place in_frame(Place p, Place origin, double angle) {
    return {(p.x - origin.x) * std::cos(angle) + (p.y - origin.y) * std::sin(angle),
            (p.y - origin.y) * std::cos(angle) - (p.x - origin.x) * std::sin(angle)};
}

/// The directions of a building with a rough wall are not those of the edge of the raster that cuts it off:
/// in these, the wall would be a staircase.
TEST(Walls, TheEdgeOfTheRasterIsNoWall) {
    constexpr double angle = 7 * std::numbers::pi / 180;
    const TraceGrid cut = paint(140, [](Place p) {
        const Place q = in_frame(p, {70, 0}, angle);
        const double rough = std::sin(0.9 * q.x) + std::sin(0.4 * q.x + 2);
        return std::abs(q.x) < 60 && q.y > -20 + 0.5 * rough ? 1 : 0;
    });
    OutlineRules rules = walls(Walls::automatic, 2.5);
    EXPECT_GE(Drawn(cut, rules).exterior(1).size(), 16U);
    rules.frame = {{0, 0}, {140, 140}};
    const Drawn drawn(cut, rules);
    const std::vector<Position> ring = drawn.exterior(1);
    EXPECT_LE(ring.size(), 10U);
    double edge = 0;   // on the first row
    double along = 0;  // elsewhere, within two degrees
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position a = ring[i];
        const Position b = ring[(i + 1) % ring.size()];
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        const double off = (std::atan2(b.y - a.y, b.x - a.x) - angle) / (std::numbers::pi / 2);
        if (a.y == 0 && b.y == 0)
            edge += length;
        else if (std::abs(off - std::round(off)) * 90 < 2)
            along += length;
    }
    EXPECT_NEAR(edge, 120, 2);
    EXPECT_GT(along, 130);
}

/// Outline of a shape alone, without ground around it, which the edge of the raster cuts off.
std::vector<Position> cut_off(std::int32_t size, const Shape& shape) {
    TraceGrid grid = paint(size, shape);
    for (std::size_t i = 0; i < grid.z.size(); ++i)
        if (grid.labels[i] == 0)
            grid.z[i] = std::numeric_limits<double>::quiet_NaN();
    OutlineRules rules = walls(Walls::automatic, 2.5);
    rules.frame = {{0, 0}, {size, size}};
    return Drawn(grid, rules).exterior(0);
}

/// Corners of a turned box below y = 0.
std::vector<Place> cut_box(Place centre, double angle, double width, double height) {
    std::vector<Place> corners;
    for (const auto& [u, v] : {std::pair(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
        corners.push_back({centre.x + u * width * std::cos(angle) - v * height * std::sin(angle),
                           centre.y + u * width * std::sin(angle) + v * height * std::cos(angle)});
    std::vector<Place> cut;
    for (std::size_t i = 0; i < 4; ++i) {
        const Place a = corners[i];
        const Place b = corners[(i + 1) % 4];
        if (a.y <= 0)
            cut.push_back(a);
        if ((a.y <= 0) != (b.y <= 0))
            cut.push_back({a.x + a.y / (a.y - b.y) * (b.x - a.x), 0});
    }
    return cut;
}

class CutRectangle : public testing::TestWithParam<int> {};

/// A building ends at the edge of the raster, exactly and at whatever angle.
TEST_P(CutRectangle, EndsAtTheEdgeOfTheRaster) {
    const double angle = GetParam() * std::numbers::pi / 180;
    const Place centre{40.3, -9.6};
    const std::vector<Position> ring =
        cut_off(80, [&](Place p) { return in_box(p, centre, angle, 44, 24) ? 1 : 0; });
    const std::vector<Place> expected = cut_box(centre, angle, 44, 24);
    EXPECT_EQ(ring.size(), expected.size());
    for (const Position corner : ring) {
        EXPECT_LE(corner.y, 0);
        double nearest = 1e9;
        for (const Place place : expected)
            nearest = std::min(nearest, std::hypot(corner.x - place.x, corner.y - place.y));
        EXPECT_LT(nearest, 3);
    }
    EXPECT_EQ(std::ranges::count(ring, 0.0, &Position::y), 2);
}

INSTANTIATE_TEST_SUITE_P(Degrees, CutRectangle, testing::Values(0, 8, 15, 25, 40, 60, 75));

TEST(Walls, AllAroundTheRaster) {
    const std::vector<Position> ring = cut_off(20, [](Place) { return 1; });
    EXPECT_EQ(ring, (std::vector<Position>{{0, 0}, {0, -20}, {20, -20}, {20, 0}}));
}

/// A dent of a cell beside the edge of the raster is noise, a bay is not.
TEST(Walls, DentsAtTheEdgeOfTheRaster) {
    const auto corners = [](double depth) {
        return cut_off(60,
                       [&](Place p) {
                           const bool bay = p.x > 28 && p.x < 34 && p.y > -depth;
                           return p.x > 10 && p.x < 50 && p.y > -30 && !bay ? 1 : 0;
                       })
            .size();
    };
    EXPECT_EQ(corners(1), 4U);
    EXPECT_EQ(corners(9), 8U);
}

/// A round tower beside the edge keeps its arc.
TEST(Walls, AnArcThatTheEdgeOfTheRasterCutsOff) {
    const std::vector<Position> ring =
        cut_off(80, [](Place p) { return std::hypot(p.x - 40.2, p.y + 5) < 20 ? 1 : 0; });
    ASSERT_GT(ring.size(), 12U);
    for (const Position corner : ring) {
        EXPECT_LE(corner.y, 0);
        EXPECT_NEAR(std::hypot(corner.x - 40.2, corner.y + 5), 20, 1);
    }
    EXPECT_EQ(std::ranges::count(ring, 0.0, &Position::y), 2);
}

/// Turns of a ring at its corners, in degrees.
std::vector<double> turns_of(const std::vector<Position>& ring) {
    std::vector<double> turns;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position a = ring[i];
        const Position b = ring[(i + 1) % ring.size()];
        const Position c = ring[(i + 2) % ring.size()];
        turns.push_back(std::atan2((b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x),
                                   (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y)) *
                        180 / std::numbers::pi);
    }
    return turns;
}

TEST(Walls, AWedgeKeepsItsSharpCorner) {
    const double half = 20 * std::numbers::pi / 180;
    const Drawn drawn(paint(90, [&](Place p) {
        const Place q = in_frame(p, {10, -45}, 0.1);
        return q.x > 0 && q.x < 60 && std::abs(q.y) < q.x * std::tan(half) ? 1 : 0;
    }));
    ASSERT_EQ(drawn.exterior(1).size(), 3U);
    EXPECT_NEAR(std::ranges::max(turns_of(drawn.exterior(1))), 140, 2);
}

TEST(Walls, ALongSlantedSideIsOneWall) {
    const double slope = 0.35;
    const Drawn drawn(paint(100, [&](Place p) {
        const Place q = in_frame(p, {20, -70}, 0.2);
        return q.x > 0 && q.x < 50 && q.y > 0 && q.y < 20 + slope * q.x ? 1 : 0;
    }));
    ASSERT_EQ(drawn.exterior(1).size(), 4U);
    std::vector<double> turns = turns_of(drawn.exterior(1));
    std::ranges::sort(turns);
    const double slant = std::atan(slope) * 180 / std::numbers::pi;
    EXPECT_NEAR(turns[0], 90 - slant, 2);
    EXPECT_NEAR(turns[3], 90 + slant, 2);
}

class SlightlySlantedWall : public testing::TestWithParam<double> {};

TEST_P(SlightlySlantedWall, IsOneWallAndAStepStaysOne) {
    const auto paint_hall = [&](const std::function<double(double)>& width) {
        return paint(150, [&](Place p) {
            const Place q = in_frame(p, {75, -75}, GetParam());
            return std::abs(q.x) < 45 && q.y > -20 && q.y < width(q.x) ? 1 : 0;
        });
    };
    constexpr double slant = 1.5;  // degrees
    const Drawn slanted(
        paint_hall([](double x) { return 20 + x * std::tan(slant * std::numbers::pi / 180); }));
    ASSERT_EQ(slanted.exterior(1).size(), 4U);
    std::vector<double> turns = turns_of(slanted.exterior(1));
    std::ranges::sort(turns);
    for (const double turn : {turns[0], turns[3]})
        EXPECT_NEAR(std::abs(turn - 90), slant, 0.8);
    EXPECT_NEAR(planar_area(slanted.outliner.outline(1)), 90 * 40, 0.01 * 90 * 40);

    const Drawn stepped(paint_hall([](double x) { return x < 5 ? 20 : 22.4; }));
    EXPECT_EQ(stepped.exterior(1).size(), 6U);
    for (const double turn : turns_of(stepped.exterior(1)))
        EXPECT_NEAR(std::abs(turn), 90, 0.05);
    EXPECT_EQ(
        Drawn(paint_hall([](double x) { return x < 5 ? 20 : 22.4; }), walls(Walls::right)).exterior(1).size(),
        6U);
}

INSTANTIATE_TEST_SUITE_P(Radians, SlightlySlantedWall, testing::Values(0.05, 0.3, 0.9, 1.7, 2.6, 3.7, 5.5));

TEST(Walls, TwoWingsHaveTheirOwnRightAngles) {
    const Drawn drawn(paint(120, [](Place p) {
        return in_box(p, {40, -60}, 0, 50, 16) || in_box(p, {80, -50}, 0.5, 50, 16) ? 1 : 0;
    }));
    const std::vector<double> turns = turns_of(drawn.exterior(1));
    const auto is_right = [](double turn) { return std::abs(std::abs(turn) - 90) < 1; };
    EXPECT_LE(turns.size(), 10U);
    EXPECT_GE(std::ranges::count_if(turns, is_right), 4);
}

TEST(Walls, ALongBlockIsDividedAsAShortOne) {
    // Its outline has more steps than are kept at a time.
    const Drawn drawn(paint(1100, [](Place p) { return in_box(p, {550, -550}, 0.3, 800, 600) ? 1 : 0; }));
    EXPECT_EQ(drawn.exterior(1).size(), 4U);
    EXPECT_NEAR(drawn.outliner.quality(1).area_change, 0, 1e-3);
}

TEST(Walls, AHalfDiscIsRoundAndACrownAtACornerIsNot) {
    const Drawn hall(paint(100, [](Place p) {
        const Place q = in_frame(p, {30, -50}, 0.1);
        return q.x > 0 && std::hypot(q.x, q.y) < 30 ? 1 : 0;
    }));
    EXPECT_EQ(hall.outliner.outline(1).arcs.size(), 1U);
    const Drawn house(paint(90, [](Place p) {
        return in_box(p, {40, -45}, 0.1, 30, 20) || std::hypot(p.x - 55, p.y + 36) < 5 ? 1 : 0;
    }));
    EXPECT_TRUE(house.outliner.outline(1).arcs.empty());
    for (const double turn : turns_of(house.exterior(1)))
        EXPECT_NEAR(std::abs(turn), 90, 1);
}

TEST(Walls, ARoundedCornerIsACorner) {
    // It lies 1.2 cells from the arc that rounds it off.
    const TraceGrid rounded = paint(60, [](Place p) {
        const Place q = in_frame(p, {30, -30}, 0.15);
        const double x = std::abs(q.x) - 12;
        const double y = std::abs(q.y) - 8;
        return x < 3 && y < 3 && (x < 0 || y < 0 || std::hypot(x, y) < 3) ? 1 : 0;
    });
    const Drawn house(rounded, walls(Walls::automatic, 2.5));
    EXPECT_EQ(house.exterior(1).size(), 4U);
}

TEST(Walls, SayHowMuchOfTheirLengthStaysAsItWasTraced) {
    const TraceGrid turned = paint(80, [](Place p) { return in_box(p, {40.3, -39.6}, 0.3, 44, 24) ? 1 : 0; });
    EXPECT_EQ(Drawn(turned).outliner.quality(1).kept_traced, 0);
    const Drawn tight(turned, walls(Walls::automatic, 0.1));  // no staircase lies so near to a wall
    EXPECT_EQ(tight.outliner.quality(1).status, OutlineStatus::kept_traced);
    EXPECT_EQ(tight.outliner.quality(1).kept_traced, 1);
    EXPECT_EQ(tight.outliner.footprint_quality(1).kept_traced, 1);
    // Two that touch along a wall of 20 cells, of which the right one's other sides are a staircase.
    const Drawn pair(paint(60,
                           [](Place p) {
                               const bool left = in_box(p, {20, -30}, 0, 20, 20);
                               const bool right =
                                   p.x > 30 && p.x < 45 && std::abs(p.y + 30) < 23 - 0.43 * p.x;
                               return left ? 1 : right ? 2 : 0;
                           }),
                     walls(Walls::automatic, 0.1));
    for (const std::size_t contour : {1U, 2U}) {
        EXPECT_GE(pair.outliner.quality(contour).kept_traced, 0);
        EXPECT_LE(pair.outliner.quality(contour).kept_traced, 1);
    }
    EXPECT_LE(pair.outliner.quality(2).deviation_cells, 0.15);
}

TEST(Walls, LAndHKeepTheirCorners) {
    const double angle = 0.35;
    const Drawn l(paint(90, [&](Place p) {
        const double u = (p.x - 45) * std::cos(angle) + (p.y + 45) * std::sin(angle);
        const double v = (p.y + 45) * std::cos(angle) - (p.x - 45) * std::sin(angle);
        return std::abs(u) < 24 && std::abs(v) < 20 && (u < -6 || v < 2) ? 1 : 0;
    }));
    EXPECT_EQ(l.exterior(1).size(), 6U);
    EXPECT_NEAR(planar_area(l.outliner.outline(1)), 48 * 40 - 30 * 18, 15);
    const Drawn h(paint(60, [](Place p) {
        return in_box(p, {15, -30}, 0, 10, 40) || in_box(p, {45, -30}, 0, 10, 40) ||
                       in_box(p, {30, -30}, 0, 24, 10)
                   ? 1
                   : 0;
    }));
    EXPECT_EQ(h.exterior(1).size(), 12U);
    EXPECT_DOUBLE_EQ(planar_area(h.outliner.outline(1)), 2 * 400 + 200);  // nothing to straighten
    EXPECT_DOUBLE_EQ(h.outliner.quality(1).deviation_cells, 0);
}

TEST(Walls, ADiscBecomesACircle) {
    const Drawn drawn(paint(60, [](Place p) { return std::hypot(p.x - 30.2, p.y + 29.7) < 18 ? 1 : 0; }));
    const FinePolygon polygon = drawn.outliner.outline(1);
    ASSERT_EQ(polygon.arcs.size(), 2U);
    EXPECT_EQ(polygon.arcs[0].edges + polygon.arcs[1].edges, polygon.exterior.size());
    for (const Position p : drawn.exterior(1))
        EXPECT_NEAR(std::hypot(p.x - 30.2, p.y + 29.7), 18, 0.4);
}

TEST(Walls, ASquareThatLacksItsCornersIsNoCircle) {
    const OutlineRules rules = walls(Walls::automatic, 2.5);
    for (const double half : {4.0, 4.5, 5.0, 6.0}) {
        const Drawn square(paint(40,
                                 [&](Place p) {
                                     const Place q = in_frame(p, {20.3, -19.8}, half / 10);
                                     const double u = std::abs(q.x);
                                     const double v = std::abs(q.y);
                                     return u < half && v < half && u + v < 1.65 * half ? 1 : 0;
                                 }),
                           rules);
        EXPECT_EQ(square.exterior(1).size(), 4U) << half;
        const Drawn disc(
            paint(40, [&](Place p) { return std::hypot(p.x - 20.3, p.y + 19.8) < half ? 1 : 0; }), rules);
        EXPECT_EQ(disc.outliner.outline(1).arcs.size(), 2U) << half;
    }
}

TEST(Walls, WhatIsSmallerThanTheToleranceStaysAsItWasTraced) {
    const Drawn drawn(paint(12, [](Place p) { return p.x > 5 && p.x < 6 && p.y < -5 && p.y > -6 ? 1 : 0; }),
                      walls(Walls::free));
    EXPECT_EQ(drawn.outliner.outline(1).exterior, fine(drawn.set.contours[1].exterior.corners()));
    EXPECT_NEAR(planar_area(drawn.outliner.outline(1)), 1, 1e-12);
}

TEST(Walls, RightAnglesAloneWhereTheyAreAskedFor) {
    const double angle = 0.3;
    // A house with a corner that is cut off.
    const Drawn drawn(paint(80,
                            [&](Place p) {
                                const double u = (p.x - 40) * std::cos(angle) + (p.y + 40) * std::sin(angle);
                                const double v = (p.y + 40) * std::cos(angle) - (p.x - 40) * std::sin(angle);
                                return std::abs(u) < 22 && std::abs(v) < 14 && u + v < 29 ? 1 : 0;
                            }),
                      walls(Walls::right));
    for (const double turn : turns_of(drawn.exterior(1)))
        EXPECT_NEAR(std::abs(turn), 90, 0.6);
}

TEST(Walls, TouchingLabelsShareTheirWall) {
    const double angle = 0.4;
    const Drawn drawn(paint(90, [&](Place p) {
        if (!in_box(p, {45, -45}, angle, 60, 20))
            return 0;
        return (p.x - 45) * std::cos(angle) + (p.y + 45) * std::sin(angle) < 3 ? 1 : 2;
    }));
    ASSERT_EQ(drawn.set.contours.size(), 3U);
    EXPECT_LE(drawn.exterior(1).size(), 6U);
    EXPECT_LE(drawn.exterior(2).size(), 6U);
    const FineRing a = drawn.outliner.footprint(1).exterior;
    const FineRing b = drawn.outliner.footprint(2).exterior;
    const std::set<FinePoint> of_a(a.begin(), a.end());
    EXPECT_EQ(std::count_if(b.begin(), b.end(), [&](FinePoint p) { return of_a.contains(p); }), 2);
    Geos geos;
    EXPECT_EQ(geos.area_outside(unit_grid.polygon(drawn.outliner.footprint(1)),
                                unit_grid.polygon(drawn.outliner.footprint(2))),
              planar_area(drawn.outliner.footprint(1)));
}

TEST(Walls, ATowerOnThreeWallsFollowsTheFootprint) {
    const double angle = 0.25;
    TraceGrid grid = paint(90, [&](Place p) { return in_box(p, {45, -45}, angle, 60, 24) ? 1 : 0; });
    for (std::int32_t row = 0; row < 90; ++row)
        for (std::int32_t col = 0; col < 90; ++col)
            if (grid.label(row, col) == 1 &&
                (col + 0.5 - 45) * std::cos(angle) + (45 - (row + 0.5)) * std::sin(angle) > 8)
                grid.z[static_cast<std::size_t>(row * 90 + col)] = 30;
    const Drawn drawn(grid, walls(), {10, 25});
    ASSERT_EQ(drawn.set.contours.size(), 3U);
    // The building has its four corners alone; the outline that the tower shares has the ends of the tower's
    // wall as well.
    EXPECT_EQ(drawn.outliner.footprint(1).exterior.size(), 4U);
    const FineRing plate = drawn.outliner.outline(1).exterior;
    const FineRing tower = drawn.outliner.outline(2).exterior;
    EXPECT_EQ(plate.size(), 6U);
    EXPECT_EQ(tower.size(), 4U);
    const std::set<FinePoint> of_plate(plate.begin(), plate.end());
    for (const FinePoint p : tower)
        EXPECT_TRUE(of_plate.contains(p));
}

/// A block with a ragged tier at 45 degrees to the grid.
std::size_t corners_of_tier(double step, double vertical_metres) {
    TraceGrid grid = paint(80, [](Place p) { return in_box(p, {40, -40}, 0, 70, 70) ? 1 : 0; });
    for (std::int32_t row = 0; row < 80; ++row)
        for (std::int32_t col = 0; col < 80; ++col) {
            const double teeth = (row * 7 + col * 13) % 5 * 0.5;
            if (in_box({col + 0.5, -(row + 0.5)}, {40, -40}, std::numbers::pi / 4, 40 + teeth, 24 + teeth))
                grid.z[static_cast<std::size_t>(row * 80 + col)] += step;
        }
    OutlineRules rules = walls();
    rules.vertical_metres = vertical_metres;
    const Drawn drawn(grid, rules, {10, 20 + step / 2});
    return drawn.outliner.outline(2).exterior.size();
}

TEST(Walls, FollowTiersTheMoreCloselyTheHigherTheirStep) {
    EXPECT_GT(corners_of_tier(8, 1), 2 * corners_of_tier(1, 1));
    EXPECT_EQ(corners_of_tier(8 / 0.3048, 0.3048), corners_of_tier(8, 1));
    EXPECT_LE(corners_of_tier(1, 1), 8U);
}

TEST(Walls, ACourtyardIsDrawnInside) {
    const double angle = 0.5;
    const Drawn drawn(paint(90, [&](Place p) {
        return in_box(p, {45, -45}, angle, 56, 40) && !in_box(p, {45, -45}, angle, 30, 16) ? 1 : 0;
    }));
    const FinePolygon polygon = drawn.outliner.outline(1);
    EXPECT_EQ(polygon.exterior.size(), 4U);
    ASSERT_EQ(polygon.interiors.size(), 1U);
    EXPECT_EQ(polygon.interiors[0].size(), 4U);
    EXPECT_NEAR(planar_area(polygon), 56 * 40 - 30 * 16, 20);
    EXPECT_EQ(Geos().invalidity({unit_grid.polygon(polygon)}), "");
}

/// Areas of the footprint, of its court and of the tower on it, with walls that are moved inward.
std::array<double, 3> inset_areas(double inset) {
    TraceGrid grid = paint(60, [](Place p) {
        return in_box(p, {30, -30}, 0, 40, 30) && !in_box(p, {20, -30}, 0, 10, 10) ? 1 : 0;
    });
    for (std::int32_t row = 20; row < 40; ++row)
        for (std::int32_t col = 32; col < 44; ++col)
            grid.z[static_cast<std::size_t>(row) * 60 + static_cast<std::size_t>(col)] = 40;
    OutlineRules rules = walls();
    rules.wall_inset = inset;
    const Drawn drawn(grid, rules, {10, 30});
    EXPECT_EQ(test::nesting_fault(drawn.set, drawn.outliner), "");
    const FinePolygon footprint = drawn.outliner.outline(1);
    EXPECT_EQ(footprint.interiors.size(), 1U);
    return {planar_area({footprint.exterior, {}}), std::abs(planar_area({footprint.interiors.at(0), {}})),
            planar_area(drawn.outliner.outline(2))};
}

TEST(Walls, ThatAreMovedInwardMakeRoofsAndTowersSmallerAndCourtsLarger) {
    // Lines along the cells' borders, and moved by a quarter of a cell on each side.
    EXPECT_EQ(inset_areas(0), (std::array{40.0 * 30, 10.0 * 10, 12.0 * 20}));
    EXPECT_EQ(inset_areas(0.25), (std::array{39.5 * 29.5, 10.5 * 10.5, 11.5 * 19.5}));
}

TEST(Walls, ThatAreMovedInwardLeaveWhatTouchesTogether) {
    OutlineRules rules = walls();
    rules.wall_inset = 0.25;
    const Drawn drawn(
        paint(60,
              [](Place p) { return std::abs(p.y + 30) < 10 && p.x > 10 && p.x < 50 ? p.x < 30 ? 1 : 2 : 0; }),
        rules);
    // The party wall stays in the middle: each has 20 x 20 cells, less a quarter on its three other sides.
    for (const std::size_t contour : {1U, 2U})
        EXPECT_EQ(planar_area(drawn.outliner.outline(contour)), 19.75 * 19.5);
}

TEST(Walls, RightAnglesAreThoseOfTheGround) {
    // Cells twice as wide as high: square corners on the ground are not square in rows and columns.
    const double angle = 0.4;
    TraceGrid grid{120, 60, {}, {}};
    for (std::int32_t row = 0; row < 120; ++row)
        for (std::int32_t col = 0; col < 60; ++col)
            grid.z.push_back(in_box({2 * (col + 0.5), -(row + 0.5)}, {60, -60}, angle, 70, 40) ? 20 : 0);
    Context context;
    const test::ContourSet set = trace_grid(grid, {10}, {}, context);
    const Georeference wide({0, 2, 0, 0, 0, -1}, TraceMode::cells);
    const Outliner outliner(*set.list, OutlineMethod::regularized, walls(), wide, 1, context);
    const WorldRing ring = wide.polygon(outliner.outline(1)).exterior;
    ASSERT_EQ(ring.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        const Position u{ring[(i + 1) % 4].x - ring[i].x, ring[(i + 1) % 4].y - ring[i].y};
        const Position v{ring[(i + 2) % 4].x - ring[(i + 1) % 4].x,
                         ring[(i + 2) % 4].y - ring[(i + 1) % 4].y};
        EXPECT_NEAR((u.x * v.x + u.y * v.y) / std::hypot(u.x, u.y) / std::hypot(v.x, v.y), 0, 0.005);
    }
}

}  // namespace
}  // namespace d2b::outline

#include "score/outline_distance.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "score/shapes.hpp"

namespace d2b::score {
namespace {

TEST(SquaredDistance, isToTheNearestPointOfASegment) {
    const OutlineSegment segment{{1, 1}, {5, 1}};
    EXPECT_DOUBLE_EQ(squared_distance({3, 4}, segment), 9);
    EXPECT_DOUBLE_EQ(squared_distance({-2, 5}, segment), 25);
    EXPECT_DOUBLE_EQ(squared_distance({6, 0}, segment), 2);
    EXPECT_DOUBLE_EQ(squared_distance({4, 5}, {{1, 1}, {1, 1}}), 25);  // a segment of no length
}

TEST(OutlineDistance, ofParallelLines) {
    const std::vector<Polyline> outline{{{0, 0}, {10, 0}}};
    const std::vector<Polyline> reference{{{-5, 1}, {15, 1}}};
    const OutlineDistance distance = outline_distance(outline, reference, 3, 0.05);
    EXPECT_NEAR(distance.length, 10, 1e-9);
    EXPECT_NEAR(distance.near, 10, 1e-9);
    EXPECT_NEAR(distance.rms.value(), 1, 1e-9);
}

TEST(OutlineDistance, ofALineThatLeavesTheReference) {
    // Distances grow from 0 to 10; those up to 3 count: the mean of their squares is 3.
    const std::vector<Polyline> outline{{{0, 0}, {0, 10}}};
    const std::vector<Polyline> reference{{{-5, 0}, {5, 0}}};
    const OutlineDistance distance = outline_distance(outline, reference, 3, 0.05);
    EXPECT_NEAR(distance.near, 3, 0.05);
    EXPECT_NEAR(distance.rms.value(), std::sqrt(3.0), 0.02);
}

TEST(OutlineDistance, goesToTheNearestOfMany) {
    // Towards a comb of teeth 1 apart: distances along y = 0 run from 0 to 0.5 and back; their mean square is
    // 1/12.
    std::vector<Polyline> comb;
    for (int i = 0; i <= 100; ++i)
        comb.push_back({{static_cast<double>(i), 0}, {static_cast<double>(i), 20}});
    const std::vector<Polyline> outline{{{0, 0.5}, {100, 0.5}}};
    EXPECT_NEAR(outline_distance(outline, comb, 3, 0.01).rms.value(), std::sqrt(1.0 / 12), 1e-4);
}

TEST(OutlineDistance, isTheSameWhateverTheEdgesAreDividedInto) {
    const std::vector<Polyline> reference{{{0, 1}, {30, 2}, {60, 0.5}}};
    Polyline divided;
    for (int i = 0; i <= 600; ++i)
        divided.push_back({i / 10.0, 0});
    const double whole =
        outline_distance(std::vector<Polyline>{{{0, 0}, {60, 0}}}, reference, 3, 0.05).rms.value();
    EXPECT_NEAR(outline_distance(std::vector<Polyline>{divided}, reference, 3, 0.05).rms.value(), whole,
                1e-4);
}

TEST(OutlineDistance, hasNoRmsWhereNothingIsNear) {
    const std::vector<Polyline> outline{{{0, 0}, {10, 0}}};
    const OutlineDistance distance =
        outline_distance(outline, std::vector<Polyline>{{{0, 4}, {10, 4}}}, 3, 0.05);
    EXPECT_NEAR(distance.length, 10, 1e-9);
    EXPECT_EQ(distance.near, 0);
    EXPECT_FALSE(distance.rms);
    EXPECT_FALSE(outline_distance(outline, {}, 3, 0.05).rms);
    EXPECT_FALSE(outline_distance({}, outline, 3, 0.05).rms);
}

TEST(OutlineDistance, countsPointsAtTheLimit) {
    const std::vector<Polyline> outline{{{0, 0}, {10, 0}}};
    EXPECT_NEAR(outline_distance(outline, std::vector<Polyline>{{{-9, 3}, {19, 3}}}, 3, 0.05).rms.value(), 3,
                1e-9);
}

constexpr double no_limit = std::numeric_limits<double>::infinity();

std::vector<Polyline> random_lines(int count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0, 100);
    std::vector<Polyline> lines;
    for (int i = 0; i < count; ++i)
        lines.push_back(
            {{place(random), place(random)}, {place(random), place(random)}, {place(random), place(random)}});
    return lines;
}

TEST(OutlineSegments, findsTheNearestAndThoseWithin) {
    const std::vector<Polyline> lines = random_lines(200);
    std::vector<OutlineSegment> all;
    for (const Polyline& line : lines)
        for (std::size_t i = 1; i < line.size(); ++i)
            all.push_back({line[i - 1], line[i]});
    const OutlineSegments segments(lines);
    for (const Position p : {Position{50, 50}, Position{-20, 3}, Position{99, 120}}) {
        double nearest = no_limit;
        std::ptrdiff_t near = 0;
        for (const OutlineSegment& segment : all) {
            nearest = std::min(nearest, squared_distance(p, segment));
            near += squared_distance(p, segment) < 30.0 * 30.0 ? 1 : 0;
        }
        EXPECT_DOUBLE_EQ(segments.distance(p, no_limit), std::sqrt(nearest));
        EXPECT_DOUBLE_EQ(segments.distance(p, std::sqrt(nearest) / 2), std::sqrt(nearest) / 2);
        std::vector<OutlineSegment> found{{{0, 0}, {0, 0}}};
        segments.within(p, 30, found);
        EXPECT_EQ(std::ssize(found), near);
    }
}

TEST(OutlineSegments, mayBePointsOrNone) {
    const OutlineSegments none({});
    EXPECT_EQ(none.distance({0, 0}, 7), 7);
    const std::vector<Polyline> point{{{3, 4}, {3, 4}}};
    EXPECT_EQ(OutlineSegments(point).distance({0, 0}, no_limit), 5);
}

}  // namespace
}  // namespace d2b::score

namespace d2b::score {
namespace {

using namespace test;

TEST(Polis, isZeroForTheSame) {
    EXPECT_EQ(polis_distance(box(0, 0, 10, 10), box(0, 0, 10, 10)), 0);
}

TEST(Polis, ofAShiftedSquare) {
    // By 1 to the right: each way, the two vertices outside of the other are 1 from it, and so are the two
    // inside of it or on its edges 0: (1 + 1 + 0 + 0) / 4 both ways.
    EXPECT_DOUBLE_EQ(polis_distance(box(0, 0, 10, 10), box(1, 0, 11, 10)), 0.5);
}

TEST(Polis, ofASquareShiftedAcross) {
    // By (1, 1): of the first, (0, 0) is sqrt(2) away, (10, 0) and (0, 10) are 1, (10, 10) is 1 inside.
    EXPECT_DOUBLE_EQ(polis_distance(box(0, 0, 10, 10), box(1, 1, 11, 11)), (std::sqrt(2) + 3) / 4);
}

TEST(Polis, ofDifferentNumbersOfVertices) {
    // The vertex on the edge of b is 0 from a; a's vertices are 0 from b but for one, which is 2.
    const WorldPolygon a = box(0, 0, 10, 10);
    const WorldPolygon b{{{0, 0}, {5, 0}, {10, 0}, {10, 8}, {0, 10}}, {}};
    // (10, 10) to the line from (10, 8) to (0, 10): |2 * 10 + 10 * 10 - 100| / sqrt(104).
    const double from_a = 20 / std::sqrt(104.0) / 4;
    EXPECT_NEAR(polis_distance(a, b), from_a / 2, 1e-12);
    EXPECT_DOUBLE_EQ(polis_distance(a, b), polis_distance(b, a));
}

TEST(Polis, countsCourtyards) {
    WorldPolygon with_court = box(0, 0, 10, 10);
    with_court.interiors = {{{4, 4}, {4, 6}, {6, 6}, {6, 4}}};
    // Its four vertices are 4 from the outer ring; there are eight.
    EXPECT_DOUBLE_EQ(polis_distance(with_court, box(0, 0, 10, 10)), 4.0 * 4 / 8 / 2);
}

}  // namespace
}  // namespace d2b::score

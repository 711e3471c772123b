#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "score/outline_distance.hpp"

namespace d2b {
namespace {

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
}  // namespace d2b

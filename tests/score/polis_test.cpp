#include <cmath>

#include <gtest/gtest.h>

#include "score/outline_distance.hpp"
#include "score/shapes.hpp"

namespace d2b::test {
namespace {

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
}  // namespace d2b::test

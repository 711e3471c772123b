#include "core/georeference.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/lattice.hpp"

namespace d2b {
namespace {

const LatticePolygon square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}}};

double signed_area(const WorldRing& ring) {
    double sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position a = ring[i];
        const Position b = ring[(i + 1) % ring.size()];
        sum += a.x * b.y - b.x * a.y;
    }
    return sum / 2;
}

TEST(Georeference, CornersAndCentres) {
    const AffineTransform north_up{1000, 2, 0, 5000, 0, -3};
    EXPECT_EQ(Georeference(north_up, TraceMode::cells).position(LatticePoint{0, 0}), (Position{1000, 5000}));
    EXPECT_EQ(Georeference(north_up, TraceMode::points).position(LatticePoint{0, 0}),
              (Position{1001, 4998.5}));
    EXPECT_EQ(Georeference(north_up, TraceMode::cells).position(LatticePoint{7, 10}), (Position{1020, 4979}));
    EXPECT_EQ(Georeference(north_up, TraceMode::cells).cell_area(), 6);
}

TEST(Georeference, UsesAllSixTerms) {
    const AffineTransform rotated{10, 0.6, 0.8, 20, 0.8, -0.6};
    const Georeference georeference(rotated, TraceMode::cells);
    EXPECT_EQ(georeference.position(LatticePoint{2, 1}), (Position{10 + 0.6 + 2 * 0.8, 20 + 0.8 - 2 * 0.6}));
    EXPECT_FALSE(georeference.axis_parallel());
    EXPECT_DOUBLE_EQ(georeference.cell_area(), 1);
    EXPECT_DOUBLE_EQ(georeference.step(1, 0).x, 0.8);
    EXPECT_DOUBLE_EQ(georeference.step(0, 1).y, 0.8);
}

TEST(Georeference, CornersRunAroundABox) {
    const Georeference grid({100, 2, 0, 500, 0, -1}, TraceMode::cells);
    EXPECT_EQ(grid.corners({{10, 20}, {13, 25}}),
              (WorldRing{{140, 490}, {140, 487}, {150, 487}, {150, 490}}));
}

TEST(Georeference, IsExactWhereRoundingKeepsLinesApart) {
    const Window window{0, 0, 1000, 1000};
    const auto exact = [&](const AffineTransform& transform) {
        return Georeference(transform, TraceMode::cells).is_exact(window);
    };
    EXPECT_TRUE(exact({500000.1, 0.1, 0, 4000000.3, 0, -0.1}));
    EXPECT_TRUE(exact({-122.3, 1e-6, 0, 47.6, 0, -1e-6}));
    EXPECT_FALSE(exact({500000.1, 0.1, 1e-9, 4000000.3, 0, -0.1}));
    // Doubles near 1e16 are two apart, and steps of 1 meet.
    EXPECT_FALSE(exact({1e16, 1, 0, 0, 0, -1}));
    EXPECT_FALSE(exact({0, 1, 0, -1e16, 0, -1}));
    EXPECT_TRUE(exact({1e16, 100, 0, 0, 0, -1}));
    EXPECT_FALSE(exact({1e16, 1e-300, 0, 0, 0, -1}));
}

TEST(Georeference, ExteriorRingsRunCounterClockwiseOnEveryGrid) {
    for (const AffineTransform& transform :
         {AffineTransform{0, 1, 0, 0, 0, -1}, AffineTransform{0, 1, 0, 0, 0, 1},
          AffineTransform{0, -1, 0, 0, 0, 1}, AffineTransform{0, 0, 1, 0, 1, 0},
          AffineTransform{0, 0.6, 0.8, 0, 0.8, -0.6}}) {
        const WorldPolygon polygon = Georeference(transform, TraceMode::cells).polygon(square);
        EXPECT_DOUBLE_EQ(signed_area(polygon.exterior), 16);
        EXPECT_DOUBLE_EQ(signed_area(polygon.interiors.front()), -1);
    }
}

TEST(Georeference, FinePointsAreExactPartsOfACell) {
    const Georeference georeference({1000, 2, 0, 5000, 0, -3}, TraceMode::cells);
    EXPECT_EQ(georeference.position(FinePoint{7 * 1024, 10 * 1024}),
              georeference.position(LatticePoint{7, 10}));
    EXPECT_EQ(georeference.position(FinePoint{512, 256}), (Position{1000.5, 4998.5}));
}

TEST(Georeference, ArcsStayOnTheirVertices) {
    FinePolygon polygon = fine(square);
    polygon.arcs = {{0, 1, 2}, {1, 3, 2}};  // from vertex 3 of the interior ring round to vertex 1
    const WorldPolygon plain = Georeference({0, 1, 0, 0, 0, -1}, TraceMode::cells).polygon(polygon);
    const WorldPolygon mirrored = Georeference({0, 1, 0, 0, 0, 1}, TraceMode::cells).polygon(polygon);
    const auto ends = [](const WorldPolygon& p, std::size_t i) {
        const WorldRing& ring = p.arcs[i].ring == 0 ? p.exterior : p.interiors[p.arcs[i].ring - 1];
        std::array<Position, 2> both{ring[p.arcs[i].first],
                                     ring[(p.arcs[i].first + p.arcs[i].edges) % ring.size()]};
        for (Position& end : both)
            end.y = std::abs(end.y);
        return both;
    };
    for (std::size_t i = 0; i < 2; ++i) {
        // The mirrored ring runs the other way, so does the arc.
        EXPECT_EQ(ends(plain, i)[0], ends(mirrored, i)[1]);
        EXPECT_EQ(ends(plain, i)[1], ends(mirrored, i)[0]);
    }
}

// An L of three squares: (0,0), (1,0), (1,1); counter-clockwise with y up: down the left side first.
const LatticeRing l_shape{{0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 1}, {0, 1}};

TEST(PackedRing, GivesItsCornersBack) {
    const PackedRing ring(l_shape);
    EXPECT_EQ(ring.corners(), l_shape);
    EXPECT_EQ(ring.corner_count(), 6U);
    EXPECT_EQ(ring.points(), 8);
    EXPECT_EQ(ring.area(), 3);
    EXPECT_EQ(ring.box().low, (LatticePoint{0, 0}));
    EXPECT_EQ(ring.box().high, (LatticePoint{2, 2}));
}

TEST(PackedRing, StartsAtTheFirstCornerWhateverTheRotation) {
    for (std::size_t shift = 0; shift < l_shape.size(); ++shift) {
        LatticeRing rotated(l_shape.begin() + static_cast<std::ptrdiff_t>(shift), l_shape.end());
        rotated.insert(rotated.end(), l_shape.begin(), l_shape.begin() + static_cast<std::ptrdiff_t>(shift));
        EXPECT_EQ(PackedRing(rotated).corners(), l_shape);
    }
}

TEST(PackedRing, InteriorRingsRunTheOtherWay) {
    const LatticeRing hole{{3, 5}, {3, 9}, {7, 9}, {7, 5}};
    const PackedRing ring(hole);
    EXPECT_EQ(ring.area(), -16);
    EXPECT_EQ(ring.corners(), hole);
}

TEST(PackedRing, KeepsStepsOfEverySize) {
    for (const std::int32_t size : {1, 63, 64, 65, 8191, 8192, 1000000, 2000000000}) {
        const LatticeRing outline{{-5, -7}, {size - 5, -7}, {size - 5, size - 7}, {-5, size - 7}};
        const PackedRing ring(outline);
        EXPECT_EQ(ring.corners(), outline) << size;
        EXPECT_EQ(ring.area(), static_cast<std::int64_t>(size) * size) << size;
        EXPECT_EQ(ring.points(), 4LL * size) << size;
    }
}

TEST(Contains, LooksAtTheSquaresCentre) {
    EXPECT_TRUE(contains(l_shape, {0, 0}));
    EXPECT_TRUE(contains(l_shape, {1, 0}));
    EXPECT_TRUE(contains(l_shape, {1, 1}));
    EXPECT_FALSE(contains(l_shape, {0, 1}));
    EXPECT_FALSE(contains(l_shape, {-1, 0}));
    EXPECT_FALSE(contains(l_shape, {1, 2}));
    EXPECT_FALSE(contains(l_shape, {1, -1}));
}

}  // namespace
}  // namespace d2b

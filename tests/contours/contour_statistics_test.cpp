#include <cmath>

#include <gtest/gtest.h>

#include "contours/reference.hpp"
#include "support/random_grid.hpp"

namespace d2b {
namespace {

using test::TraceGrid;

/// Where the points of a contour lie, seen from its polygon: in -trace cells in its cells; in -trace points
/// at the corners of its squares.
std::set<LatticePoint> points_of(const Contour& contour, TraceMode mode) {
    const std::set<LatticePoint> squares = test::squares_inside(contour);
    if (mode == TraceMode::cells)
        return squares;
    std::set<LatticePoint> points;
    for (const LatticePoint s : squares)
        for (const LatticePoint p : {s, LatticePoint{s.row + 1, s.col}, LatticePoint{s.row, s.col + 1},
                                     LatticePoint{s.row + 1, s.col + 1}})
            points.insert(p);
    return points;
}

class PointStatistics : public testing::TestWithParam<unsigned> {};

TEST_P(PointStatistics, CellsAreCountedInTheContourThatHoldsThem) {
    const test::RandomGridCase c = test::random_grid(2 * GetParam());
    Context context;
    const test::ContourSet set = test::trace_grid(c.grid, c.thresholds, {TraceMode::cells}, context);
    for (std::size_t i = 0; i < set.contours.size(); ++i) {
        std::set<LatticePoint> own = points_of(set.contours[i], TraceMode::cells);
        for (const Contour& child : set.contours)
            if (child.parent == static_cast<std::int64_t>(i))
                for (const LatticePoint p : points_of(child, TraceMode::cells))
                    own.erase(p);
        double sum = 0;
        for (const LatticePoint p : own)
            sum += c.grid.at(p.row, p.col);
        const PointStats& stats = set.contours[i].own;
        ASSERT_EQ(stats.n, static_cast<std::int64_t>(own.size()));
        if (stats.n > 0) {
            const double largest = c.thresholds.back() + 0.5;
            EXPECT_DOUBLE_EQ(FixedPoint(largest).mean(stats.sum, stats.n),
                             sum / static_cast<double>(stats.n));
        }
    }
}

TEST_P(PointStatistics, EveryPointLiesInTheRightPolygonAtEveryLevel) {
    const test::RandomGridCase c = test::random_grid(GetParam());
    Context context;
    const test::ContourSet set = test::trace_grid(c.grid, c.thresholds, {c.mode}, context);
    std::vector<std::set<LatticePoint>> squares_at(c.thresholds.size() + 1);
    for (const Contour& contour : set.contours)
        for (const LatticePoint s : test::squares_inside(contour))
            EXPECT_TRUE(squares_at[static_cast<std::size_t>(contour.key.level)].insert(s).second)
                << "two contours of a level cover a square";
    std::vector<std::size_t> expected(c.thresholds.size() + 1, 0);
    for (const auto& reference : test::reference_contours(c.grid, c.thresholds, c.mode))
        expected[static_cast<std::size_t>(reference.level)] += reference.squares.size();
    for (std::size_t level = 0; level < expected.size(); ++level)
        EXPECT_EQ(squares_at[level].size(), expected[level]);
}

TEST_P(PointStatistics, EachPointIsCountedOnceAndInAContourAroundIt) {
    const test::RandomGridCase c = test::random_grid(2 * GetParam() + 1);
    Context context;
    const test::ContourSet set = test::trace_grid(c.grid, c.thresholds, {TraceMode::points}, context);
    std::set<LatticePoint> all;
    std::int64_t counted = 0;
    for (const Contour& contour : set.contours) {
        const auto points = points_of(contour, TraceMode::points);
        all.insert(points.begin(), points.end());
        counted += contour.own.n;
        EXPECT_LE(contour.own.n, static_cast<std::int64_t>(points.size()));
    }
    EXPECT_EQ(counted, static_cast<std::int64_t>(all.size()));
}

INSTANTIATE_TEST_SUITE_P(Seeds, PointStatistics, testing::Range(500U, 600U));

TEST(Percentiles, AreThoseOfAllPointsOfTheBuilding) {
    TraceGrid grid{12, 12, std::vector<double>(144, 0.0), {}};
    for (int i = 0; i < 100; ++i)
        grid.z[static_cast<std::size_t>((1 + i / 10) * 12 + 1 + i % 10)] = 100 + i;
    Context context;
    const test::ContourSet set = test::trace_grid(grid, {50, 150}, {TraceMode::cells}, context);
    ASSERT_EQ(set.roofs.size(), 1U);
    // 100 values, 100 to 199: the nearest rank of a share is 99 + 100 share.
    EXPECT_EQ(set.roofs[0].percentiles[0], 149);
    EXPECT_EQ(set.roofs[0].percentiles[1], 169);
    EXPECT_EQ(set.roofs[0].percentiles[2], 189);
    EXPECT_EQ(set.roofs[0].percentiles[3], 194);
}

}  // namespace
}  // namespace d2b

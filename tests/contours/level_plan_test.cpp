#include "contours/level_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "contours/reference.hpp"
#include "support/error_of.hpp"
#include "support/random_grid.hpp"

namespace d2b::contours {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

ElevationStatistics statistics_of(const std::vector<double>& values) {
    ElevationStatistics statistics;
    statistics.add(values);
    return statistics;
}

LevelOptions with_lod(int lod) {
    LevelOptions options;
    options.lod = lod;
    return options;
}

TEST(LevelPlan, SlicesMeanPlusMinusDeviation) {
    // mean 5, sample standard deviation sqrt(32 / 7); LOD 3 cuts at the quarters of 2 s.
    Context context;
    const LevelPlan plan = plan_global_levels(statistics_of({2, 4, 4, nan, 4, 5, 5, 7, 9}), with_lod(3),
                                              LevelSource::global, context);
    const double s = std::sqrt(32.0 / 7.0);
    ASSERT_EQ(plan.level_count(), 4);
    EXPECT_DOUBLE_EQ(plan.threshold(1, 1), 5 - s / 2);
    EXPECT_DOUBLE_EQ(plan.threshold(1, 2), 5);
    EXPECT_DOUBLE_EQ(plan.threshold(1, 3), 5 + s / 2);
    EXPECT_EQ(plan.threshold(1, 0), 2);
    EXPECT_EQ(context.report.valid_points, 8);
    EXPECT_EQ(context.report.maximum, 9);
    EXPECT_DOUBLE_EQ(context.report.standard_deviation, s);
}

TEST(LevelPlan, DropsWhatCutsNothingAndSaysSo) {
    Context context;
    LevelOptions options;
    options.fixed = {7, 1, 3, 3, 0, 9, 12, 1};  // the minimum is 1, the maximum 9
    const LevelPlan plan =
        plan_global_levels(statistics_of({1, 9, 4}), options, LevelSource::global, context);
    EXPECT_EQ(plan.thresholds[1], (std::vector<double>{3, 7}));
    EXPECT_EQ(context.report.counted(Reason::threshold_not_above_minimum), 3);  // 0, 1 and 1
    EXPECT_EQ(context.report.counted(Reason::threshold_not_below_maximum), 2);
    EXPECT_EQ(context.report.counted(Reason::threshold_repeated), 1);
}

TEST(LevelPlan, SlicesBelowTheMinimumAreDropped) {
    // 0 0 0 0 10: mean 2, s = sqrt(20) = 4.47; the first of four slices lies below 0.
    Context context;
    const LevelPlan plan =
        plan_global_levels(statistics_of({0, 0, 0, 0, 10}), with_lod(4), LevelSource::global, context);
    EXPECT_EQ(plan.level_count(), 4);
    EXPECT_EQ(context.report.counted(Reason::threshold_not_above_minimum), 1);
}

TEST(LevelPlan, IntervalsCountFromTheirOffset) {
    Context context;
    LevelOptions options;
    options.interval = 5;
    options.offset = 2;
    EXPECT_EQ(
        plan_global_levels(statistics_of({-4, 17.5}), options, LevelSource::global, context).thresholds[1],
        (std::vector<double>{-3, 2, 7, 12, 17}));
    EXPECT_EQ(plan_global_levels(statistics_of({2, 17}), options, LevelSource::global, context).thresholds[1],
              (std::vector<double>{7, 12}));
}

TEST(LevelPlan, EnormousElevationsNeitherOverflowNorNeverEnd) {
    Context context;
    for (const int lod : {1, 4}) {
        const LevelPlan plan = plan_global_levels(statistics_of({-1.7e308, 1.7e308}), with_lod(lod),
                                                  LevelSource::global, context);
        for (const double t : plan.thresholds[1])
            EXPECT_TRUE(std::isfinite(t));
    }
    LevelOptions options;
    options.interval = 1e13;  // 1e30 and the next double are 1.4e14 apart: no threshold fits between them
    EXPECT_LE(plan_global_levels(statistics_of({1e30, 1.0000000000000002e30}), options, LevelSource::global,
                                 context)
                  .level_count(),
              1);
}

TEST(LevelPlan, TooManyLevelsAreRefused) {
    Context context;
    LevelOptions options;
    options.interval = 1e-6;
    EXPECT_EQ(test::error_of<OptionError>([&] {
                  static_cast<void>(
                      plan_global_levels(statistics_of({0, 1}), options, LevelSource::global, context));
              }),
              "-i 1e-06 gives more than 65534 levels on this DEM; use a larger interval.");
    for (int i = 1; i < 70000; ++i)
        options.fixed.push_back(i / 70000.0);
    EXPECT_EQ(test::error_of<OptionError>([&] {
                  static_cast<void>(
                      plan_global_levels(statistics_of({0, 1}), options, LevelSource::global, context));
              }),
              "-fl and -lod give at most 65534 levels, not 69999.");
}

TEST(LevelPlan, FlatAndEmptyDataHaveNoThresholds) {
    Context context;
    EXPECT_EQ(
        plan_global_levels(statistics_of({3, 3, 3}), with_lod(4), LevelSource::global, context).level_count(),
        1);
    EXPECT_EQ(plan_global_levels(statistics_of({nan, nan}), with_lod(4), LevelSource::global, context)
                  .level_count(),
              1);
    EXPECT_EQ(plan_global_levels(statistics_of({}), with_lod(4), LevelSource::global, context).level_count(),
              1);
}

TEST(ElevationStatistics, BandsInAnyOrderGiveTheSame) {
    ElevationStatistics a = statistics_of({0.1, 7.3, -4});
    const ElevationStatistics b = statistics_of({1e9, 3.3});
    ElevationStatistics c = statistics_of({1e9, 3.3});
    a.merge(b);
    c.merge(statistics_of({-4, 7.3, 0.1}));
    EXPECT_EQ(a.moments.mean(), c.moments.mean());
    EXPECT_EQ(a.moments.standard_deviation(), c.moments.standard_deviation());
    EXPECT_EQ(a.minimum, -4);
    EXPECT_EQ(a.maximum, 1e9);
}

TEST(Quantise, SearchesAndCountsAlike) {
    std::vector<double> many;
    for (int i = 0; i < 300; ++i)
        many.push_back(i);
    const ElevationBand band{{0, 1, 5}, {-1, 0, 0.5, 299, 1000}};
    const LevelPlan plan{-1, {{}, many}};
    EXPECT_EQ(quantise<std::uint16_t>(band, {{0, 1, 5}, {}}, plan).counts,
              (std::vector<std::uint16_t>{1, 1, 2, 300, 301}));
}

/// Runs of cells with the same label are looked at several at a time, those of many thresholds one by one.
TEST(Quantise, CountsByTheDefinition) {
    std::mt19937 random(5);
    LevelPlan plan{0, {{}, {}, {}, {}}};
    for (int k = 0; k < 9; ++k)
        plan.thresholds[1].push_back(10 * k + 5);
    for (int k = 0; k < 40; ++k)
        plan.thresholds[2].push_back(2 * k + 1);
    plan.thresholds[3] = {50};
    ElevationBand band{{0, 4, 700}, {}};
    LabelBand labels{band.shape, {}};
    while (band.elevations.size() < band.shape.size()) {
        const auto label = static_cast<Label>(random() % 4);
        for (auto n = random() % 600; n > 0 && band.elevations.size() < band.shape.size(); --n) {
            band.elevations.push_back(random() % 9 == 0 ? nan : static_cast<double>(random() % 1000) / 10);
            labels.labels.push_back(label);
        }
    }
    for (const bool footprints : {false, true}) {
        plan.footprints = footprints;
        const auto counts = quantise<std::uint8_t>(band, labels, plan).counts;
        EXPECT_TRUE(std::ranges::equal(quantise<std::uint16_t>(band, labels, plan).counts, counts));
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const double z = band.elevations[i];
            const Label label = labels.labels[i];
            auto expected = std::isnan(z) ? 0
                                          : 1 + std::ranges::count_if(plan.thresholds[label],
                                                                      [z](double t) { return z > t; });
            if (footprints && label != 0 && expected < 2)
                expected = 2;
            ASSERT_EQ(counts[i], expected) << z << " " << label;
            ASSERT_EQ(quantise<std::uint8_t>(z, label, plan), expected) << z << " " << label;
        }
        plan.thresholds[1].swap(plan.thresholds[2]);
    }
}

using test::TraceGrid;

/// Points of a contour, seen from its polygon: in -trace cells those in its cells; in -trace points those
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
}  // namespace d2b::contours

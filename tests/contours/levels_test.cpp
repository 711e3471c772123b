#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "contours/level_plan.hpp"

namespace d2b {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

ElevationStatistics statistics_of(const std::vector<double>& values) {
    ElevationStatistics statistics;
    statistics.add({{0, 1, static_cast<std::int32_t>(values.size())}, values});
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

TEST(LevelPlan, LodOneIsTheMean) {
    Context context;
    EXPECT_EQ(plan_global_levels(statistics_of({0, 0, 0, 8}), with_lod(1), LevelSource::global, context)
                  .threshold(1, 1),
              2);
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
    try {
        static_cast<void>(plan_global_levels(statistics_of({0, 1}), options, LevelSource::global, context));
        FAIL();
    } catch (const OptionError& error) {
        EXPECT_STREQ(error.what(),
                     "-i 1e-06 gives more than 65534 levels on this DEM; use a larger interval.");
    }
    for (int i = 1; i < 70000; ++i)
        options.fixed.push_back(i / 70000.0);
    try {
        static_cast<void>(plan_global_levels(statistics_of({0, 1}), options, LevelSource::global, context));
        FAIL();
    } catch (const OptionError& error) {
        EXPECT_STREQ(error.what(), "-fl and -lod give at most 65534 levels, not 69999.");
    }
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

TEST(Quantise, IsStrict) {
    const LevelPlan plan{0, {{}, {10, 20}}};
    const ElevationBand band{{0, 1, 7}, {nan, 0, 10, 10.000001, 20, 20.000001, -5}};
    const auto levels = quantise<std::uint8_t>(band, {{0, 1, 7}, {}}, plan);
    EXPECT_EQ(levels.counts, (std::vector<std::uint8_t>{0, 1, 1, 2, 2, 3, 1}));
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

TEST(Quantise, EachLabelHasItsThresholds) {
    const LevelPlan plan{0, {{}, {10}, {1, 2, 3}}};
    const ElevationBand band{{0, 1, 3}, {5, 5, 5}};
    EXPECT_EQ(quantise<std::uint8_t>(band, {{0, 1, 3}, {0, 1, 2}}, plan).counts,
              (std::vector<std::uint8_t>{1, 1, 4}));
    EXPECT_EQ(plan.level_count(), 4);
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

}  // namespace
}  // namespace d2b

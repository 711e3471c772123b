#include "contours/building_levels.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "contours/level_plan.hpp"
#include "support/error_of.hpp"

namespace d2b::contours {
namespace {

constexpr double not_valid = std::numeric_limits<double>::quiet_NaN();
using Thresholds = std::vector<double>;

/// A row of elevations with their labels.
BuildingStatistics statistics_of(const std::vector<double>& values, const std::vector<Label>& labels,
                                 Label highest, double largest = 100, double metres = 0) {
    const BandShape shape{0, 1, static_cast<std::int32_t>(values.size())};
    BuildingStatistics statistics(highest, FixedPoint(largest), metres);
    statistics.add(constant_runs({shape, values}, {shape, labels}));
    return statistics;
}

/// The thresholds of a building with these elevations, which stands at 0.
Thresholds thresholds_of(const std::vector<double>& values, const LevelOptions& options,
                         LevelSource source = LevelSource::building, double metres = 1,
                         const Thresholds& global = {}, double ground = 0) {
    const std::vector<Label> labels(values.size(), 1);
    return plan_building_levels(statistics_of(values, labels, 1, 1000, metres), {0, ground},
                                {-5, {{}, global}}, options, source, metres)
        .thresholds[1];
}

LevelOptions each(int lod) {
    LevelOptions options;
    options.lod = lod;
    return options;
}

void expect_near(const Thresholds& found, const Thresholds& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i], expected[i], 1e-6) << i;
}

TEST(BuildingStatistics, CountsEachLabelsValidPoints) {
    const BuildingStatistics statistics =
        statistics_of({3, not_valid, 5, 7, 100, not_valid}, {1, 1, 1, 2, 0, 3}, 3);
    EXPECT_EQ(statistics.labels(), 3U);
    EXPECT_EQ(statistics.of(1).n, 2);
    EXPECT_EQ(statistics.of(1).lowest, 3);
    EXPECT_EQ(statistics.of(1).highest, 5);
    EXPECT_EQ(statistics.fixed().mean(statistics.of(1).sum, 2), 4);
    EXPECT_EQ(statistics.of(2).n, 1);
    EXPECT_EQ(statistics.of(3).n, 0);
}

TEST(BuildingStatistics, AreTheSameOfABuildingsCellsAlone) {
    // Two rows of a building, which meet with the same elevation.
    const BuildingCells cells{{{7, 2, 5}, {8, 0, 3}}, {3, not_valid, 5, 5, 5, -4}};
    BuildingStatistics statistics(2, FixedPoint(100), 1);
    statistics.add(constant_runs(cells, 2));
    const BuildingStatistics of_band = statistics_of(cells.elevations, {2, 2, 2, 2, 2, 2}, 2, 100, 1);
    EXPECT_EQ(statistics.of(2).n, 5);
    EXPECT_EQ(statistics.of(2).lowest, -4);
    EXPECT_EQ(statistics.of(2).highest, 5);
    EXPECT_NEAR(statistics.fixed().mean(statistics.of(2).sum, 5), 2.8, 1e-9);
    EXPECT_EQ(statistics.of(2).sum, of_band.of(2).sum);
    EXPECT_EQ(statistics.of(1).n, 0);
    const auto counts = [](const BuildingStatistics& of) {
        std::vector<std::pair<std::int64_t, std::int64_t>> bins;
        for (const HistogramBin& bin : of.histogram(2).bins(100).bins)
            bins.emplace_back(bin.bin, bin.points);
        return bins;
    };
    EXPECT_EQ(counts(statistics), counts(of_band));
    EXPECT_EQ(counts(statistics).size(), 3U);
}

TEST(BuildingStatistics, DoNotDependOnTheBands) {
    const std::vector<double> values{3.25, 9.125, 5, 7, 0.1, 12};
    const std::vector<Label> labels{1, 2, 1, 2, 1, 2};
    const BuildingStatistics whole = statistics_of(values, labels, 2);
    BuildingStatistics parts(2, FixedPoint(100));
    for (const std::int32_t row : {2, 0, 1}) {
        const BandShape shape{row, 1, 2};
        const auto at = static_cast<std::ptrdiff_t>(2 * row);
        parts.add(constant_runs({shape, {values.begin() + at, values.begin() + at + 2}},
                                {shape, {labels.begin() + at, labels.begin() + at + 2}}));
    }
    for (const Label label : {Label{1}, Label{2}}) {
        EXPECT_EQ(parts.of(label).sum, whole.of(label).sum);
        EXPECT_EQ(parts.of(label).coarse_squares, whole.of(label).coarse_squares);
        EXPECT_EQ(parts.of(label).n, whole.of(label).n);
    }
}

TEST(BuildingLevels, SliceMeanPlusMinusDeviation) {
    // Mean 15, s = sqrt(8 * 25 / 7). Four thresholds cut 2 s into fifths; the ground is recorded as level 1.
    const double s = std::sqrt(200.0 / 7);
    expect_near(thresholds_of({10, 10, 10, 10, 20, 20, 20, 20}, each(4)),
                {0, 15 - 0.6 * s, 15 - 0.2 * s, 15 + 0.2 * s, 15 + 0.6 * s});
    expect_near(thresholds_of({10, 10, 10, 10, 20, 20, 20, 20}, each(1)), {0, 15});
}

TEST(BuildingLevels, AreAtLeastHalfAMetreApart) {
    // Two points 2 a apart have s = a sqrt(2).
    const auto pair = [](double range_m, double metres) {
        const double a = range_m / 2 / std::sqrt(2.0) / metres;
        return thresholds_of({20 - a, 20 + a}, each(4), LevelSource::building, metres);
    };
    EXPECT_EQ(pair(0.99, 1), Thresholds{0});  // half of it is less than half a metre
    expect_near(pair(1.01, 1), {0, 20});      // two slices
    expect_near(pair(1.49, 1), {0, 20});      //
    expect_near(pair(1.6, 1), {0, 20 - 1.6 / 6, 20 + 1.6 / 6});
    EXPECT_EQ(pair(2.49, 1).size(), 1U + 3);
    EXPECT_EQ(pair(2.51, 1).size(), 1U + 4);
    EXPECT_EQ(pair(30, 1).size(), 1U + 4);         // as many as -lod says
    EXPECT_EQ(pair(0.99, 0.3048), Thresholds{0});  // metres, whatever the unit
    expect_near(pair(1.6, 0.3048), {0, 20 - 1.6 / 6 / 0.3048, 20 + 1.6 / 6 / 0.3048});
    EXPECT_EQ(pair(2.49, 0.3048).size(), 1U + 3);
}

TEST(BuildingLevels, OfFlatRoofsAndSinglePointsAreNone) {
    EXPECT_EQ(thresholds_of({12, 12, 12, 12}, each(4)), Thresholds{0});
    EXPECT_EQ(thresholds_of({12}, each(4)), Thresholds{0});
    EXPECT_EQ(thresholds_of({not_valid, not_valid}, each(4)), Thresholds{0});
}

TEST(BuildingLevels, ThatCutNothingAreLeftOut) {
    // 19 at 10 and one at 30: mean 11, s = 4.47; the lower slices lie below all points.
    std::vector<double> values(19, 10);
    values.push_back(30);
    const double s = std::sqrt((19 + 361) / 19.0);
    expect_near(thresholds_of(values, each(4)), {0, 11 - 0.2 * s, 11 + 0.2 * s, 11 + 0.6 * s});
    // Mirrored, the highest lies above all.
    for (double& z : values)
        z = 40 - z;
    expect_near(thresholds_of(values, each(4)), {0, 29 - 0.6 * s, 29 - 0.2 * s, 29 + 0.2 * s});
}

TEST(BuildingLevels, ExplicitOnesHoldWithinEachBuilding) {
    LevelOptions options = each(4);
    options.fixed = {5, 10, 12, 20, 25};
    const Thresholds usable{5, 10, 12, 20, 25};  // as plan_global_levels gives them
    const LevelPlan global{1, {{}, usable}};
    const BuildingStatistics statistics = statistics_of({10, 11, 20, 3, 6, 30, 30}, {1, 1, 1, 2, 2, 3, 3}, 3);
    const LevelPlan plan =
        plan_building_levels(statistics, {0, 2, 2.5, 8}, global, options, LevelSource::building, 1);
    EXPECT_TRUE(plan.footprints);
    EXPECT_EQ(plan.minimum, 1);
    ASSERT_EQ(plan.thresholds.size(), 4U);
    EXPECT_EQ(plan.thresholds[0], Thresholds{});
    // 10 is the lowest: not all points exceed it. None exceeds 20.
    EXPECT_EQ(plan.thresholds[1], (Thresholds{2, 10, 12}));
    EXPECT_EQ(plan.thresholds[2], (Thresholds{2.5, 5}));
    EXPECT_EQ(plan.thresholds[3], Thresholds{8});
    EXPECT_EQ(plan.level_count(), 4);
}

TEST(BuildingLevels, IntervalsHoldWithinEachBuilding) {
    LevelOptions options = each(4);
    options.interval = 5;
    EXPECT_EQ(thresholds_of({11, 19}, options, LevelSource::building, 1, {5, 10, 15, 20, 25}),
              (Thresholds{0, 15}));
}

TEST(BuildingLevels, GlobalSlicesAreThoseOfTheDem) {
    LevelOptions options = each(4);
    EXPECT_EQ(thresholds_of({10, 20}, options, LevelSource::global, 1, {5, 12, 19, 26}),
              (Thresholds{0, 12, 19}));
}

TEST(BuildingLevels, NaturalOnesLieBetweenRoofs) {
    LevelOptions options = each(4);
    options.lod = 1;
    const std::vector<double> roofs{10.05, 10.15, 10.05, 10.1, 15.05, 15.15, 15.05};
    // Roofs of ten and fifteen: the border is the bin in which the higher one begins.
    expect_near(thresholds_of(roofs, options, LevelSource::natural), {0, 15});
    // More would be closer than half a metre to it, but for none.
    options.lod = 9;
    expect_near(thresholds_of(roofs, options, LevelSource::natural), {0, 15});
    // The same in feet.
    std::vector<double> feet;
    for (const double z : roofs)
        feet.push_back(z / 0.3048);
    expect_near(thresholds_of(feet, options, LevelSource::natural, 0.3048), {0, 15 / 0.3048});
}

TEST(BuildingLevels, NaturalOnesTakeOffAsMuchAsTenPointsThatAreAMetreOff) {
    const auto thresholds = [](double step) {
        std::vector<double> roofs(8, 10.05);
        roofs.insert(roofs.end(), 2, 10.05 + step);
        const std::vector<Label> labels(roofs.size(), 1);
        constexpr double hardly_any = 1e-6;  // square metres a point, of a border as long as a cell
        return plan_building_levels(statistics_of(roofs, labels, 1, 1000, 1), {0, 0}, {-5, {{}, {}}}, each(4),
                                    LevelSource::natural, 1, hardly_any)
            .thresholds[1];
    };
    // Eight and two points a step apart: 8 x 2 / 10 of its square.
    EXPECT_EQ(thresholds(2.4), (Thresholds{0}));  // 9.2
    expect_near(thresholds(2.6), {0, 12.6});      // 10.8
}

TEST(BuildingLevels, BelowTheGroundAreLeftOut) {
    LevelOptions options = each(4);
    options.fixed = {12, 14, 16};
    EXPECT_EQ(thresholds_of({10, 20}, options, LevelSource::building, 1, {12, 14, 16}, 14),
              (Thresholds{14, 16}));
}

TEST(BuildingLevels, WithoutBuildingsThereAreNone) {
    const LevelPlan plan = plan_building_levels(statistics_of({1, 2}, {0, 0}, 0), {0}, {1, {{}, {}}}, each(4),
                                                LevelSource::building, 1);
    EXPECT_EQ(plan.level_count(), 1);
    EXPECT_TRUE(plan.footprints);
}

TEST(GlobalLevels, HaveNoSlicesWhereEachBuildingHasItsOwn) {
    ElevationStatistics statistics;
    statistics.add(std::vector<double>{1, 5, 9, 14});
    Context context;
    EXPECT_EQ(plan_global_levels(statistics, each(4), LevelSource::building, context).thresholds[1],
              Thresholds{});
    EXPECT_EQ(context.report.valid_points, 4);
    EXPECT_EQ(context.report.maximum, 14);
    LevelOptions options = each(4);
    options.interval = 5;
    EXPECT_EQ(plan_global_levels(statistics, options, LevelSource::building, context).thresholds[1],
              (Thresholds{5, 10}));
}

/// The ground is one more: a building that exceeds all levels may have one less than the whole DEM.
TEST(BuildingLevels, AreAsManyAsSixteenBitsCount) {
    const auto levels_with = [](int count) {
        Thresholds global(static_cast<std::size_t>(count));
        std::iota(global.begin(), global.end(), 1);
        LevelOptions options;
        options.interval = 1;
        return plan_building_levels(statistics_of({0.5, 70000}, {1, 1}, 1, 1e6), {0, 0}, {-5, {{}, global}},
                                    options, LevelSource::building, 1);
    };
    const LevelPlan most = levels_with(65533);
    EXPECT_EQ(most.level_count(), 65535);
    const ElevationBand top{{0, 1, 1}, {70000}};
    EXPECT_EQ(quantise<std::uint16_t>(top, {{0, 1, 1}, {1}}, most).counts, std::vector<std::uint16_t>{65535});
    EXPECT_EQ(test::error_of<OptionError>([&] { static_cast<void>(levels_with(65534)); }),
              "-i 1 gives more than 65534 levels on this DEM; use a larger interval.");
}

}  // namespace
}  // namespace d2b::contours

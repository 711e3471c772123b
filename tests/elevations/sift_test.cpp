#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "elevations/filter_invalid.hpp"

namespace d2b {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

ElevationBand band_of(std::int32_t rows, std::int32_t cols, std::vector<double> values,
                      std::int32_t first_row = 0) {
    return {{first_row, rows, cols}, std::move(values)};
}

Window whole(const ElevationBand& band) {
    return {0, 0, band.shape.rows, band.shape.cols};
}

ValidityRules on_land_in(double metres) {
    return {land_elevations.times(1 / metres), {100 / metres, 30 / metres}, metres, {}};
}

/// Report of a sift of one row.
SuspiciousValues seen_in(std::vector<double> values, const ValidityRules& rules = on_land_in(1)) {
    const auto cols = static_cast<std::int32_t>(values.size());
    ElevationBand band = band_of(1, cols, std::move(values));
    SuspiciousValues seen(rules);
    (void)filter_invalid(band, rules, seen, whole(band));
    return seen;
}

TEST(Sift, TakesOutWhatIsOutsideOfTheLimitsAndCountsIt) {
    ElevationBand band = band_of(2, 4, {1, -500, 9000, -500.001, none, 9000.5, -9999, -9999});
    SuspiciousValues seen(on_land_in(1));
    (void)filter_invalid(band, on_land_in(1), seen, whole(band));
    EXPECT_EQ(seen.outside.cells(), 4);
    ASSERT_TRUE(seen.outside.most());
    EXPECT_EQ(seen.outside.most()->value, -9999);
    EXPECT_EQ(seen.outside.most()->cells, 2);
    EXPECT_EQ(seen.outside.text("'x'"),
              "4 cells of 'x' have elevations from -9999 to 9000.5 (2 of them -9999)");
    EXPECT_EQ(std::vector(band.elevations.begin(), band.elevations.begin() + 3),
              (std::vector<double>{1, -500, 9000}));
    EXPECT_TRUE(std::all_of(band.elevations.begin() + 3, band.elevations.end(),
                            [](double z) { return std::isnan(z); }));
}

TEST(ValueCounts, SayWhichValueAsLongAsThereAreFew) {
    ValueCounts counts;
    counts.add(5);
    EXPECT_EQ(counts.text("it"), "1 cell of it has the elevation 5");
    counts.add(5);
    EXPECT_EQ(counts.text("it"), "2 cells of it have the elevation 5");
    ValueCounts others;
    for (int i = 0; i < 31; ++i)
        others.add(100 + i);
    counts.merge(others);
    EXPECT_EQ(counts.most()->value, 5);
    counts.add(1);
    EXPECT_FALSE(counts.most());
    EXPECT_EQ(counts.text("it"), "34 cells of it have elevations from 1 to 130");
}

TEST(ValueCounts, WriteLargeFloatsAsSuch) {
    EXPECT_EQ(value_text(static_cast<double>(-3.4e38F)), "-3.4e+38");
    EXPECT_EQ(value_text(-3.4e38), "-3.4e+38");
    EXPECT_EQ(value_text(1e300), "1e+300");
    EXPECT_EQ(value_text(-9999), "-9999");
    EXPECT_EQ(stored_value(-99.99, 0.01, 0), -9999);
    EXPECT_EQ(stored_value(0.3, 1, 0), 0.3);
}

TEST(ValueBins, FindWhatManyCellsShareFarFromAllOthers) {
    std::vector<double> town(5000);
    for (std::size_t i = 0; i < town.size(); ++i)
        town[i] = 200 + static_cast<double>(i % 97) / 10;
    const auto shared = [&](std::size_t cells, double value, double metres = 1) {
        std::vector<double> values = town;
        for (std::size_t i = 0; i < cells; ++i)
            values[i * 400 + 7] = value;
        return seen_in(values, on_land_in(metres)).bins.shared(static_cast<std::int64_t>(values.size()));
    };
    ASSERT_EQ(shared(10, 0).size(), 1U);
    EXPECT_EQ(shared(10, 0)[0].value, 0);
    EXPECT_EQ(shared(10, 0)[0].cells, 10);
    EXPECT_EQ(shared(9, 0).size(), 0U);
    EXPECT_EQ(shared(10, 260).size(), 1U);
    EXPECT_EQ(shared(10, 259).size(), 0U);       // 49.4 above the highest
    EXPECT_EQ(shared(10, 100, 0.5).size(), 0U);  // 100 units are 50 m
    EXPECT_EQ(shared(10, 99, 0.5).size(), 1U);
    std::vector<double> ramp(20000, 200);
    std::fill_n(ramp.begin(), 19, 0.0);                      // less than a thousandth
    EXPECT_EQ(seen_in(ramp).bins.shared(20000).size(), 1U);  // 200 itself
    ramp[19] = 0;
    EXPECT_EQ(seen_in(ramp).bins.shared(20000).size(), 2U);
    EXPECT_EQ(seen_in(std::vector<double>(100, 5)).bins.shared(100).size(), 0U);  // nothing else is there
}

/// The lowest value as the sentence defines it.
std::optional<double> far_below_by_hand(const std::vector<double>& values) {
    std::map<double, std::int64_t> counts;
    std::int64_t all = 0;
    for (const double z : values)
        if (!std::isnan(z)) {
            ++counts[z];
            ++all;
        }
    if (counts.size() < 2)
        return {};
    const auto [value, cells] = *counts.begin();
    const bool is_far = std::next(counts.begin())->first - value > ValueBins::below_m;
    return is_far && 10 * cells >= all ? std::optional(value) : std::nullopt;
}

TEST(ValueBins, FindTheLowestValueFarBelowTheOthers) {
    const auto found = [](double value, double metres = 1) {
        std::vector<double> values(1000);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = i % 10 == 0 ? value : 20 + static_cast<double>(i % 97) / 10;
        return seen_in(values, on_land_in(metres)).bins.far_below(1000);
    };
    ASSERT_TRUE(found(0).has_value());
    EXPECT_EQ(found(0)->value, 0);
    EXPECT_EQ(found(0)->cells, 100);
    EXPECT_TRUE(found(17.9));
    EXPECT_FALSE(found(18)) << "2 m";
    EXPECT_FALSE(found(40)) << "above the others";
    EXPECT_FALSE(found(17.9, 0.5)) << "1.05 m";
    EXPECT_FALSE(seen_in(std::vector<double>(1000, 5)).bins.far_below(1000)) << "nothing else is there";
}

/// Shares as the sentence defines them, a value against all others.
std::map<double, std::int64_t> shared_by_hand(const std::vector<double>& values) {
    std::map<double, std::int64_t> counts;
    for (const double z : values)
        if (!std::isnan(z))
            ++counts[z];
    std::int64_t all = 0;
    for (const auto& [value, cells] : counts)
        all += cells;
    std::map<double, std::int64_t> shared;
    for (const auto& [value, cells] : counts) {
        bool alone = counts.size() > 1;
        for (const auto& [other, unused] : counts)
            alone = alone && (other == value || std::abs(other - value) > ValueBins::apart_m);
        if (alone && cells >= 10 && 1000 * cells >= all)
            shared[value] = cells;
    }
    return shared;
}

TEST(ValueBins, AgreeWithTheSentenceWhateverTheBands) {
    std::mt19937 random(17);
    int found = 0;
    for (int round = 0; round < 200; ++round) {
        const std::int32_t cols = 1 + static_cast<std::int32_t>(random() % 200);
        const std::int32_t rows = 1 + static_cast<std::int32_t>(random() % 40);
        std::vector<double> values(static_cast<std::size_t>(rows * cols));
        const int kinds = 1 + static_cast<int>(random() % 6);
        for (double& z : values) {
            const auto kind = static_cast<int>(random() % static_cast<unsigned>(kinds));
            z = kind == 5 ? none
                          : 37.0 * kind * (kind % 2 == 0 ? 1 : 4) +
                                (kind == 3 ? static_cast<double>(random() % 7) : 0);
        }
        const ValidityRules rules = on_land_in(1);
        SuspiciousValues merged(rules);
        for (std::int32_t row = 0; row < rows;) {
            const std::int32_t some = std::min(rows - row, 1 + static_cast<std::int32_t>(random() % 5));
            ElevationBand band =
                band_of(some, cols, {values.begin() + row * cols, values.begin() + (row + some) * cols});
            SuspiciousValues seen(rules);
            (void)filter_invalid(band, rules, seen, whole(band));
            merged.merge(seen);
            row += some;
        }
        std::map<double, std::int64_t> shared;
        const auto valid = std::ranges::count_if(values, [](double z) { return !std::isnan(z); });
        for (const SharedValue& one : merged.bins.shared(valid))
            shared[one.value] = one.cells;
        EXPECT_EQ(shared, shared_by_hand(values)) << round;
        const std::optional<SharedValue> low = merged.bins.far_below(valid);
        EXPECT_EQ(low ? std::optional(low->value) : std::nullopt, far_below_by_hand(values)) << round;
        found += static_cast<int>(shared.size());
    }
    EXPECT_GT(found, 50);
}

/// How far each cell is above the highest of its neighbours; -infinity where it or all of them are not valid.
std::vector<double> above_neighbours(std::int32_t rows, std::int32_t cols, const std::vector<double>& z) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> above(z.size(), -infinity);
    for (std::int32_t r = 0; r < rows; ++r)
        for (std::int32_t c = 0; c < cols; ++c) {
            double highest = -infinity;
            for (std::int32_t i = std::max(r - 1, 0); i <= std::min(r + 1, rows - 1); ++i)
                for (std::int32_t j = std::max(c - 1, 0); j <= std::min(c + 1, cols - 1); ++j)
                    if (const double other = z[static_cast<std::size_t>(i * cols + j)];
                        (i != r || j != c) && other > highest)
                        highest = other;
            const auto at = static_cast<std::size_t>(r * cols + c);
            if (!std::isnan(z[at]) && highest > -infinity)
                above[at] = z[at] - highest;
        }
    return above;
}

TEST(Spikes, AreThoseOfTheSentenceWhateverTheBands) {
    std::mt19937 random(23);
    std::size_t found = 0;
    for (int round = 0; round < 300; ++round) {
        const std::int32_t cols = 1 + static_cast<std::int32_t>(random() % 150);
        const std::int32_t rows = 1 + static_cast<std::int32_t>(random() % 30);
        std::vector<double> values(static_cast<std::size_t>(rows * cols));
        for (double& z : values) {
            const auto kind = random() % 40;
            z = kind == 0  ? none
                : kind < 4 ? 20.0 + static_cast<double>(random() % 200)
                           : static_cast<double>(random() % 10);
            if (round % 3 == 0 && random() % 2 == 0)
                z = none;
        }
        const std::vector<double> above = above_neighbours(rows, cols, values);
        std::vector<double> by_bands(values.size(), -std::numeric_limits<double>::infinity());
        SpikeSeams seams;
        std::int32_t before = 0;
        const auto note = [&](const std::vector<Spike>& spikes) {
            for (const Spike& spike : spikes)
                if (!spike.stands_alone() && spike.above(30))
                    by_bands[static_cast<std::size_t>((before + spike.row) * cols + spike.col)] =
                        spike.elevation - spike.around;
        };
        for (std::int32_t row = 0; row < rows;) {
            const std::int32_t some = std::min(rows - row, 1 + static_cast<std::int32_t>(random() % 4));
            ElevationBand band =
                band_of(some, cols, {values.begin() + row * cols, values.begin() + (row + some) * cols}, row);
            SuspiciousValues seen(on_land_in(1));
            const std::vector<ColumnRun> steep = filter_invalid(band, on_land_in(1), seen, whole(band));
            note(seams.add(band, find_spikes(band, steep, {100, 30})));
            before = row;
            row += some;
        }
        note(seams.finish());
        for (std::size_t i = 0; i < values.size(); ++i)
            if (above[i] > 30 || by_bands[i] > 30) {
                EXPECT_EQ(by_bands[i], above[i]) << round << " " << i;
                ++found;
            }
    }
    EXPECT_GT(found, 1000U);
}

TEST(Sift, CountsTheNoDataValueThatIsNoneAnyMore) {
    ValidityRules rules = on_land_in(1);
    rules.overridden_nodata = 7;
    EXPECT_EQ(seen_in({7, 8, none, 7}, rules).overridden_nodata, 2);
}

}  // namespace
}  // namespace d2b

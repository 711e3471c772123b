#include "contours/natural_breaks.hpp"

#include <functional>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace d2b::contours {
namespace {

using Breaks = std::vector<std::int64_t>;

double error_of(const std::vector<HistogramBin>& bins, const Breaks& breaks) {
    double error = 0;
    for (std::size_t k = 0; k <= breaks.size(); ++k) {
        double n = 0;
        double sum = 0;
        const auto inside = [&](const HistogramBin& bin) {
            return (k == 0 || bin.bin >= breaks[k - 1]) && (k == breaks.size() || bin.bin < breaks[k]);
        };
        for (const HistogramBin& bin : bins)
            if (inside(bin)) {
                n += static_cast<double>(bin.points);
                sum += static_cast<double>(bin.points * bin.bin);
            }
        for (const HistogramBin& bin : bins)
            if (inside(bin)) {
                const double away = static_cast<double>(bin.bin) - sum / n;
                error += static_cast<double>(bin.points) * away * away;
            }
    }
    return error;
}

/// The least error of up to `most` breaks, of all there are.
double least_error(const std::vector<HistogramBin>& bins, int most, std::int64_t least_bins) {
    double least = std::numeric_limits<double>::infinity();
    Breaks breaks;
    const std::function<void(std::size_t)> choose = [&](std::size_t from) {  // NOLINT(misc-no-recursion)
        least = std::min(least, error_of(bins, breaks));
        if (static_cast<int>(breaks.size()) == most)
            return;
        for (std::size_t i = from; i < bins.size(); ++i) {
            if (bins[i].bin - (breaks.empty() ? bins[0].bin : breaks.back()) < least_bins)
                continue;
            breaks.push_back(bins[i].bin);
            choose(i + 1);
            breaks.pop_back();
        }
    };
    choose(1);
    return least;
}

TEST(NaturalBreaks, AreAsManyAsAreWorthTheirPrice) {
    // Two bins of ten points each, 10 apart, and two points 2 above the higher one. Without a break the error
    // is 20 * 25 and more, with one 10 * 2 * 4 * 2 / 12 = 6.67, with two nothing.
    const std::vector<HistogramBin> bins{{10, 10}, {20, 10}, {22, 2}};
    EXPECT_EQ(natural_breaks(bins, 4, 1), (Breaks{20, 22}));
    EXPECT_EQ(natural_breaks(bins, 4, 1, {6.6, 0}), (Breaks{20, 22}));
    EXPECT_EQ(natural_breaks(bins, 4, 1, {6.7, 0}), (Breaks{20}));
    EXPECT_EQ(natural_breaks(bins, 4, 1, {1000, 0}), Breaks{});
    const double whole = error_of(bins, {});
    EXPECT_EQ(natural_breaks(bins, 4, 1, {0, 6.7 / whole}), (Breaks{20}));
    EXPECT_EQ(natural_breaks(bins, 4, 1, {0, 6.6 / whole}), (Breaks{20, 22}));
}

TEST(NaturalBreaks, LieBetweenRoofs) {
    // Roofs at 30, 55 and 120, each a little rough.
    const std::vector<HistogramBin> bins{{29, 40}, {30, 400}, {31, 60},   {54, 20}, {55, 300},
                                         {57, 10}, {119, 5},  {120, 100}, {121, 30}};
    EXPECT_EQ(natural_breaks(bins, 1, 5), (Breaks{119}));
    EXPECT_EQ(natural_breaks(bins, 2, 5), (Breaks{54, 119}));
}

TEST(NaturalBreaks, AreNoneInOneBin) {
    EXPECT_TRUE(natural_breaks({}, 3, 1).empty());
    EXPECT_TRUE(natural_breaks(std::vector<HistogramBin>{{7, 100}}, 3, 1).empty());
    EXPECT_TRUE(natural_breaks(std::vector<HistogramBin>{{7, 1}, {90, 1}}, 0, 1).empty());
}

TEST(NaturalBreaks, KeepTheirDistance) {
    const std::vector<HistogramBin> bins{{0, 9}, {3, 9}, {6, 9}, {9, 9}};
    EXPECT_EQ(natural_breaks(bins, 9, 1), (Breaks{3, 6, 9}));
    EXPECT_EQ(natural_breaks(bins, 9, 4), (Breaks{6}));
    EXPECT_EQ(natural_breaks(bins, 9, 9), (Breaks{9}));
    EXPECT_TRUE(natural_breaks(bins, 9, 10).empty());
}

TEST(NaturalBreaks, AreAsGoodAsTheBestOfAll) {
    std::mt19937 random(7);
    const auto up_to = [&](unsigned n) { return static_cast<std::int64_t>(random() % n); };
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<HistogramBin> bins;
        std::int64_t bin = -up_to(50);
        for (std::int64_t i = 0; i < 2 + up_to(9); ++i) {
            bins.push_back({bin, 1 + up_to(20)});
            bin += 1 + up_to(6);
        }
        const int most = 1 + static_cast<int>(up_to(4));
        const std::int64_t distance = 1 + up_to(8);
        const Breaks found = natural_breaks(bins, most, distance);
        ASSERT_LE(static_cast<int>(found.size()), most);
        for (std::size_t i = 1; i < found.size(); ++i)
            ASSERT_GE(found[i] - found[i - 1], distance);
        ASSERT_NEAR(error_of(bins, found), least_error(bins, most, distance), 1e-6) << trial;
    }
}

TEST(ElevationHistogram, PutsABordersElevationBelow) {
    ElevationHistogram histogram;
    for (const double z : {12.3, 12.31, 12.4, -0.05, 0.0})
        histogram.add(z);
    const auto [width, bins] = histogram.bins(100);
    EXPECT_EQ(width, 0.1);
    ASSERT_EQ(bins.size(), 3U);
    EXPECT_EQ(bins[0].bin, -1);
    EXPECT_EQ(bins[0].points, 2);
    EXPECT_EQ(bins[1].bin, 122);
    EXPECT_EQ(bins[1].points, 1);
    EXPECT_EQ(bins[2].bin, 123);
    EXPECT_EQ(bins[2].points, 2);
}

TEST(ElevationHistogram, HasAsManyBinsAsAskedFor) {
    ElevationHistogram histogram;
    for (int i = -500; i < 500; ++i)
        histogram.add(0.1 * i + 0.05);
    const auto [width, bins] = histogram.bins(300);
    EXPECT_EQ(width, 0.4);
    ASSERT_EQ(bins.size(), 250U);
    EXPECT_EQ(bins.front().bin, -125);
    for (const HistogramBin& bin : bins)
        EXPECT_EQ(bin.points, 4);
}

TEST(ElevationHistogram, TakesAnyNumber) {
    ElevationHistogram histogram;
    for (const double z : {-1e300, 0.0, 1e300})
        histogram.add(z);
    EXPECT_EQ(histogram.bins(2).bins.size(), 2U);
}

}  // namespace
}  // namespace d2b::contours

#include "detect/detection_passes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "looks_case.hpp"
#include "support/test_threads.hpp"

namespace d2b::detect {
namespace {

using namespace test;

constexpr std::size_t nothing = NestedCandidate::nothing;
using Choice = std::vector<bool>;

TEST(MaxWeightAntichain, TakesWhatGainsSomething) {
    const std::vector<NestedCandidate> apart{{2, nothing}, {-1, nothing}, {0, nothing}};
    EXPECT_EQ(max_weight_antichain(apart), (Choice{true, false, false}));
    EXPECT_TRUE(max_weight_antichain({}).empty());
}

TEST(MaxWeightAntichain, TakesTheInnerOnesWhereTogetherTheyGainAsMuch) {
    std::vector<NestedCandidate> two_in_one{{2, 2}, {4, 2}, {5, nothing}};
    EXPECT_EQ(max_weight_antichain(two_in_one), (Choice{true, true, false}));
    two_in_one[2].gain = 6;
    EXPECT_EQ(max_weight_antichain(two_in_one), (Choice{true, true, false}));
    two_in_one[2].gain = 7;
    EXPECT_EQ(max_weight_antichain(two_in_one), (Choice{false, false, true}));
}

TEST(MaxWeightAntichain, LooksThroughWhatGainsNothing) {
    const std::vector<NestedCandidate> chain{{3, 1}, {-5, 2}, {2, nothing}};
    EXPECT_EQ(max_weight_antichain(chain), (Choice{true, false, false}));
}

/// Whether one of them lies in another, at any depth.
bool nest(const std::vector<NestedCandidate>& candidates, unsigned chosen) {
    for (std::size_t i = 0; i < candidates.size(); ++i)
        if ((chosen >> i & 1U) != 0)
            for (std::size_t j = candidates[i].parent; j != nothing; j = candidates[j].parent)
                if ((chosen >> j & 1U) != 0)
                    return true;
    return false;
}

TEST(MaxWeightAntichain, HasTheLargestSumOfAllChoices) {
    std::mt19937 random(5);
    for (int round = 0; round < 200; ++round) {
        std::vector<NestedCandidate> candidates(8);
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            const std::size_t after = candidates.size() - i - 1;
            const std::size_t parent = i + 1 + random() % (after + 1);
            candidates[i] = {static_cast<double>(random() % 21) - 8,
                             parent < candidates.size() ? parent : nothing};
        }
        const Choice found = max_weight_antichain(candidates);
        unsigned as_bits = 0;
        double sum = 0;
        for (std::size_t i = 0; i < candidates.size(); ++i)
            if (found[i]) {
                as_bits |= 1U << i;
                sum += candidates[i].gain;
            }
        EXPECT_FALSE(nest(candidates, as_bits));
        double best = 0;
        for (unsigned chosen = 0; chosen < 1U << candidates.size(); ++chosen) {
            double other = 0;
            for (std::size_t i = 0; i < candidates.size(); ++i)
                other += (chosen >> i & 1U) != 0 ? candidates[i].gain : 0;
            if (!nest(candidates, chosen))
                best = std::max(best, other);
        }
        EXPECT_EQ(sum, best);
    }
}

using Rows = std::vector<std::string>;

Rows drawing_of(const Candidates& judged) {
    return drawing(mask_of(judged.regions, threads()));
}

TEST(SelectCandidates, AHouseWithoutItsCrownIsBetterThanWithIt) {
    // 4 ln 9 = 8.8 is more than 8 ln 2 = 5.5.
    const std::vector<Candidates> passes{judged({"##..", "##.."}, {0.9}),
                                         judged({"####", "####"}, {2.0 / 3})};
    const Candidates best = select_candidates(passes, 1, threads());
    EXPECT_EQ(drawing_of(best), (Rows{"##..", "##.."}));
    ASSERT_EQ(best.objects.size(), 1U);
    EXPECT_EQ(best.objects[0].confidence, 0.9);
    EXPECT_EQ(best.objects[0].cells, 4);
    EXPECT_EQ(best.features[0].smooth, 0.9);
}

TEST(SelectCandidates, AWholeHouseIsBetterThanItsPieces) {
    // 8 ln 2 = 5.5 is more than twice 2 ln 3 = 2.2.
    const std::vector<Candidates> passes{judged({"#..#", "#..#"}, {0.75, 0.75}),
                                         judged({"####", "####"}, {2.0 / 3})};
    const Candidates best = select_candidates(passes, 0, threads());
    EXPECT_EQ(drawing_of(best), (Rows{"####", "####"}));
    ASSERT_EQ(best.objects.size(), 1U);
    EXPECT_EQ(best.objects[0].confidence, 2.0 / 3);
}

TEST(SelectCandidates, WhatIsDoubtedAtTheUsualLookStaysDoubtfulUnlessItTouchesWhatIsChosen) {
    const std::vector<Candidates> passes{
        judged({"##......", "##......", "........", "......##"}, {0.9, 0.4}),
        judged({"###..##.", "##...##.", "........", "#......."}, {0.4, 0.2, 0.3})};
    const Candidates best = select_candidates(passes, 1, threads());
    EXPECT_EQ(drawing_of(best), (Rows{"##...##.", "##...##.", "........", "#......."}));
    ASSERT_EQ(best.objects.size(), 3U);
    EXPECT_EQ(best.objects[0].confidence, 0.9);
    EXPECT_EQ(best.objects[1].confidence, 0.2);
    EXPECT_EQ(best.objects[2].confidence, 0.3);
}

TEST(SelectCandidates, ChosenOnesThatTouchAreOneAsTheLargerIs) {
    const std::vector<Candidates> passes{judged({"##....", "##...."}, {0.9}),
                                         judged({"..####", "..####"}, {0.8})};
    const Candidates best = select_candidates(passes, 0, threads());
    ASSERT_EQ(best.objects.size(), 1U);
    EXPECT_EQ(best.objects[0].confidence, 0.8);
    EXPECT_EQ(best.objects[0].cells, 12);
    EXPECT_EQ(best.features[0].smooth, 0.8);
}

TEST(SelectCandidates, WhatIsFoundAfterAllIsNotLeftOut) {
    std::vector<Candidates> passes{judged({"##....", "##...."}, {0.9}), judged({"......", "......"}, {})};
    passes[1].rejected.small = {{0, 1}, {1, 5}};
    passes[1].rejected.crowns = {{{1, 0}, 3}, {{0, 4}, 2}};
    passes[1].rejected.low = {{0, 0}, {1, 4}};
    const RejectedObjects rejected = select_candidates(passes, 1, threads()).rejected;
    EXPECT_EQ(rejected.small, (std::vector<FirstCell>{{1, 5}}));
    ASSERT_EQ(rejected.crowns.size(), 1U);
    EXPECT_EQ(rejected.crowns[0].cells, 2);
    EXPECT_EQ(rejected.low, (std::vector<FirstCell>{{1, 4}}));
}

TEST(MergeCandidates, IsInScanOrder) {
    std::array<Candidates, 2> passes{judged({".##...", ".##...", "......", "..####"}, {0.9, 0.7}),
                                     judged({"....#.", "....#.", "#.....", "#....."}, {0.4, 0.6})};
    passes[0].rejected.small = {{2, 2}, {3, 0}};
    passes[0].rejected.crowns = {{{1, 5}, 3}};
    const Candidates both = merge_candidates(passes, threads());
    EXPECT_EQ(drawing_of(both), (Rows{".##.#.", ".##.#.", "#.....", "#.####"}));
    ASSERT_EQ(both.objects.size(), 4U);
    const std::vector<double> confidences{0.9, 0.4, 0.6, 0.7};
    const std::vector<std::int64_t> cells{4, 2, 2, 4};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(both.objects[i].confidence, confidences[i]);
        EXPECT_EQ(both.features[i].smooth, confidences[i]);
        EXPECT_EQ(both.objects[i].cells, cells[i]);
        EXPECT_EQ(both.regions.cells[i + 1], cells[i]);
    }
    EXPECT_EQ(both.rejected.small, (std::vector<FirstCell>{{2, 2}}));
    ASSERT_EQ(both.rejected.crowns.size(), 1U);
    EXPECT_EQ(both.rejected.crowns[0].cells, 3);
}

/// Results where a quarter of the cells was filled.
struct Chosen {
    explicit Chosen(const Town& town, Executor& by = threads()) {
        const Scene scene = town.scene();
        SceneCells cells = scene_cells(scene, {}, by);
        quality.filled = 0.25;
        usual = find_candidates(scene, cells, min_area_m2, quality, by);
        best = multi_threshold_candidates(scene, cells, min_area_m2, quality, usual, by);
    }

    SurfaceQuality quality;
    Candidates usual;
    Candidates best;
};

TEST(MultiThreshold, FindARoughHouseWithLessConfidence) {
    const Chosen chosen(two_houses());
    ASSERT_EQ(chosen.usual.objects.size(), 1U);
    ASSERT_EQ(chosen.best.objects.size(), 2U);
    EXPECT_EQ(mask_of(chosen.best.regions, threads()).at(18, 23), 1);
    const double plain = classify(chosen.best.features[1], chosen.quality.filled).confidence;
    const double now = chosen.best.objects[1].confidence;
    EXPECT_NEAR(std::log(plain / (1 - plain)) - std::log(now / (1 - now)), 0.85, 1e-9);
}

/// A house whose rows and columns bend by so much, and every other diagonal by more.
Town rough_town(double bend) {
    Town town(30, 40, {2.5, 2.5});
    town.build([&](std::int32_t r, std::int32_t c) {
        const bool in = r >= 10 && r < 16 && c >= 14 && c < 20;
        return in ? 106 + static_cast<float>(bend / 2) * static_cast<float>(r % 2 + c % 2) : unknown;
    });
    return town;
}

TEST(MultiThreshold, FindAHouseThatOnlyTheWidestLimitsSuit) {
    // Up to 0.71 m suits 1.4 times the limits, up to 0.82 m three times the margin.
    EXPECT_EQ(Chosen(rough_town(0.78)).best.objects.size(), 1U);
    EXPECT_EQ(Chosen(rough_town(1)).best.objects.size(), 0U);
}

TEST(MultiThreshold, LeaveASmoothHouseAsItIs) {
    const Chosen chosen(two_houses());
    ASSERT_EQ(chosen.best.objects.size(), 2U);
    EXPECT_EQ(chosen.best.objects[0].cells, chosen.usual.objects[0].cells);
    EXPECT_NEAR(chosen.best.objects[0].confidence, chosen.usual.objects[0].confidence, 0.01);
}

TEST(MultiThreshold, FindARoughHouseOnCoarseCellsThatNoneIsWithoutAPoint) {
    // Up to 0.30 m is smooth enough for the usual look, up to 0.42 m for the widest.
    const auto found = [](double bend) {
        const Town town = rough_town(bend);
        Context context;
        return detect_buildings(town.scene(), {}, min_area_m2, context).buildings;
    };
    EXPECT_EQ(found(0.1), 1);
    EXPECT_EQ(found(0.36), 1);
    EXPECT_EQ(found(0.6), 0);
}

}  // namespace
}  // namespace d2b::detect

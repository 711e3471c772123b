#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "detect/detection_passes.hpp"
#include "looks_case.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

using test::drawing;
using test::judged;
using test::threads;
using Rows = std::vector<std::string>;

Rows drawing_of(const Candidates& judged) {
    return drawing(mask_of(judged.regions, threads()));
}

TEST(BestOfLooks, AHouseWithoutItsCrownIsBetterThanWithIt) {
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

TEST(BestOfLooks, AWholeHouseIsBetterThanItsPieces) {
    // 8 ln 2 = 5.5 is more than twice 2 ln 3 = 2.2.
    const std::vector<Candidates> passes{judged({"#..#", "#..#"}, {0.75, 0.75}),
                                         judged({"####", "####"}, {2.0 / 3})};
    const Candidates best = select_candidates(passes, 0, threads());
    EXPECT_EQ(drawing_of(best), (Rows{"####", "####"}));
    ASSERT_EQ(best.objects.size(), 1U);
    EXPECT_EQ(best.objects[0].confidence, 2.0 / 3);
}

TEST(BestOfLooks, WhatIsDoubtedAtTheUsualLookStaysDoubtfulUnlessItTouchesWhatIsChosen) {
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

TEST(BestOfLooks, ChosenOnesThatTouchAreOneAsTheLargerIs) {
    const std::vector<Candidates> passes{judged({"##....", "##...."}, {0.9}),
                                         judged({"..####", "..####"}, {0.8})};
    const Candidates best = select_candidates(passes, 0, threads());
    ASSERT_EQ(best.objects.size(), 1U);
    EXPECT_EQ(best.objects[0].confidence, 0.8);
    EXPECT_EQ(best.objects[0].cells, 12);
    EXPECT_EQ(best.features[0].smooth, 0.8);
}

TEST(BestOfLooks, WhatIsFoundAfterAllIsNotLeftOut) {
    std::vector<Candidates> passes{judged({"##....", "##...."}, {0.9}), judged({"......", "......"}, {})};
    passes[1].rejected.small = {{0, 1}, {1, 5}};
    passes[1].rejected.crowns = {{{1, 0}, 3}, {{0, 4}, 2}};
    passes[1].rejected.low = {{0, 0}};
    const RejectedObjects rejected = select_candidates(passes, 1, threads()).rejected;
    EXPECT_EQ(rejected.small, (std::vector<FirstCell>{{1, 5}}));
    ASSERT_EQ(rejected.crowns.size(), 1U);
    EXPECT_EQ(rejected.crowns[0].cells, 2);
    EXPECT_EQ(rejected.low, (std::vector<FirstCell>{{0, 0}}));
}

TEST(BestOfLooks, IsTheSameOnAnyNumberOfThreads) {
    std::mt19937 random(2);
    Mask strict = test::random_blocks(300, 200, 300, random);
    Mask wide = strict;
    for (std::size_t i = 0; i < wide.size(); ++i)
        if (random() % 3 == 0)
            wide.values[i] = 1;
    std::vector<Candidates> passes;
    for (const Mask& mask : {strict, wide}) {
        Candidates& found = passes.emplace_back();
        found.regions = connected_regions(mask, 1, 0, threads());
        for (std::size_t label = 1; label < found.regions.cells.size(); ++label)
            found.objects.push_back({static_cast<double>(random() % 99 + 1) / 100, CounterEvidence::rough,
                                     found.regions.cells[label]});
        found.features.resize(found.objects.size());
    }
    Executor one(1);
    Executor several(5);
    const Candidates alone = select_candidates(passes, 0, one);
    const Candidates shared = select_candidates(passes, 0, several);
    EXPECT_EQ(drawing_of(alone), drawing_of(shared));
    ASSERT_EQ(alone.objects.size(), shared.objects.size());
    for (std::size_t i = 0; i < alone.objects.size(); ++i)
        EXPECT_EQ(alone.objects[i].confidence, shared.objects[i].confidence);
}

}  // namespace
}  // namespace d2b

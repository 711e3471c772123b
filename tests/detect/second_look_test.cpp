#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "detect/detection_passes.hpp"
#include "looks_case.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

using test::build_rough;
using test::build_smooth;
using test::drawing;
using test::judged;
using test::min_area_m2;
using test::threads;
using test::Town;
using test::two_houses;

/// What two looks find where a quarter of the cells was filled.
struct Looked {
    explicit Looked(const Town& town, Executor& by = threads()) {
        const Scene scene = town.scene();
        SceneCells cells = scene_cells(scene, {}, by);
        quality.filled = 0.25;
        first = find_candidates(scene, cells, min_area_m2, quality, by);
        second = relaxed_pass(scene, cells, min_area_m2, quality, first.regions, by);
    }

    SurfaceQuality quality;
    Candidates first;
    Candidates second;
};

TEST(SecondLook, FindsWhatWasTooRoughAndNothingTwice) {
    const Looked looked(two_houses());
    ASSERT_EQ(looked.first.objects.size(), 1U);
    EXPECT_EQ(mask_of(looked.first.regions, threads()).at(7, 7), 1);
    ASSERT_EQ(looked.second.objects.size(), 1U);
    const Mask second = mask_of(looked.second.regions, threads());
    EXPECT_EQ(second.at(18, 23), 1);
    EXPECT_EQ(second.at(7, 7), 0);
    EXPECT_GE(looked.second.objects[0].cells, 32) << "36 but for the corners";
}

TEST(SecondLook, HasLessConfidence) {
    const Looked looked(two_houses());
    ASSERT_EQ(looked.second.objects.size(), 1U);
    const double plain = classify(looked.second.features[0], looked.quality.filled).confidence;
    const double now = looked.second.objects[0].confidence;
    EXPECT_NEAR(std::log(plain / (1 - plain)) - std::log(now / (1 - now)), 0.8, 1e-9);
}

TEST(SecondLook, WhatItFindsDoesNotTouchWhatWasFound) {
    std::mt19937 random(3);
    Town town(120, 120, {2.5, 2.5});
    for (std::int32_t r = 4; r < 110; r += 12)
        for (std::int32_t c = 4; c < 110; c += 12) {
            const auto side = static_cast<std::int32_t>(4 + random() % 4);
            const auto wing = static_cast<std::int32_t>(3 + random() % 5);
            build_smooth(town, {r, c, r + side, c + side});
            build_rough(town, {r, c + side, r + side, c + side + wing});
        }
    const Looked looked(town);
    EXPECT_GT(looked.second.objects.size(), 10U);
    const Mask first = mask_of(looked.first.regions, threads());
    const Mask second = mask_of(looked.second.regions, threads());
    for (std::int32_t r = 1; r < 119; ++r)
        for (std::int32_t c = 1; c < 119; ++c)
            for (const std::int32_t down : {-1, 0, 1})
                for (const std::int32_t right : {-1, 0, 1})
                    ASSERT_FALSE(second.at(r, c) == 1 && first.at(r + down, c + right) == 1)
                        << r << ", " << c;
    const Candidates both = merge_candidates(looked.first, looked.second, threads());
    EXPECT_EQ(both.objects.size(), looked.first.objects.size() + looked.second.objects.size());
}

TEST(SecondLook, IsTheSameOnAnyNumberOfThreads) {
    const Town town = two_houses();
    Executor one(1);
    Executor several(5);
    const Looked alone(town, one);
    const Looked shared(town, several);
    EXPECT_EQ(drawing(mask_of(alone.second.regions, one)), drawing(mask_of(shared.second.regions, several)));
    ASSERT_EQ(alone.second.objects.size(), shared.second.objects.size());
    EXPECT_EQ(alone.second.objects[0].confidence, shared.second.objects[0].confidence);
}

TEST(SecondLook, IsForThinPointsAlone) {
    EXPECT_FALSE(needs_relaxed_pass(0));
    EXPECT_FALSE(needs_relaxed_pass(0.1));
    EXPECT_TRUE(needs_relaxed_pass(0.11));
}

TEST(United, IsInScanOrder) {
    Candidates one = judged({".##...", ".##...", "......", "..####"}, {0.9, 0.7});
    one.rejected.small = {{2, 2}};
    one.rejected.crowns = {{{1, 5}, 3}};
    Candidates other = judged({"....#.", "....#.", "#.....", "#....."}, {0.4, 0.6});
    other.rejected.crowns = {{{0, 0}, 2}};
    const Candidates both = merge_candidates(one, other, threads());
    EXPECT_EQ(drawing(mask_of(both.regions, threads())),
              (std::vector<std::string>{".##.#.", ".##.#.", "#.....", "#.####"}));
    ASSERT_EQ(both.objects.size(), 4U);
    const std::vector<double> confidences{0.9, 0.4, 0.6, 0.7};
    const std::vector<std::int64_t> cells{4, 2, 2, 4};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(both.objects[i].confidence, confidences[i]);
        EXPECT_EQ(both.features[i].smooth, confidences[i]);
        EXPECT_EQ(both.objects[i].cells, cells[i]);
        EXPECT_EQ(both.regions.cells[i + 1], cells[i]);
    }
    EXPECT_EQ(both.rejected.small, one.rejected.small);
    ASSERT_EQ(both.rejected.crowns.size(), 2U);
    EXPECT_EQ(both.rejected.crowns[0].cells, 3);
    EXPECT_EQ(both.rejected.crowns[1].cells, 2);
}

}  // namespace
}  // namespace d2b

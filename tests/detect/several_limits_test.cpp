#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "detect/detection_passes.hpp"
#include "looks_case.hpp"
#include "support/test_threads.hpp"

namespace d2b {
namespace {

using test::min_area_m2;
using test::threads;
using test::Town;
using test::two_houses;

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

TEST(SeveralLimits, FindARoughHouseWithLessConfidence) {
    const Chosen chosen(two_houses());
    ASSERT_EQ(chosen.usual.objects.size(), 1U);
    ASSERT_EQ(chosen.best.objects.size(), 2U);
    EXPECT_EQ(mask_of(chosen.best.regions, threads()).at(18, 23), 1);
    const double plain = classify(chosen.best.features[1], chosen.quality.filled).confidence;
    const double now = chosen.best.objects[1].confidence;
    EXPECT_NEAR(std::log(plain / (1 - plain)) - std::log(now / (1 - now)), 1.1, 1e-9);
}

TEST(SeveralLimits, LeaveASmoothHouseAsItIs) {
    const Chosen chosen(two_houses());
    ASSERT_EQ(chosen.best.objects.size(), 2U);
    EXPECT_EQ(chosen.best.objects[0].cells, chosen.usual.objects[0].cells);
    EXPECT_NEAR(chosen.best.objects[0].confidence, chosen.usual.objects[0].confidence, 0.01);
}

TEST(SeveralLimits, AreTheSameOnAnyNumberOfThreads) {
    Executor one(1);
    Executor several(5);
    const Chosen alone(two_houses(), one);
    const Chosen shared(two_houses(), several);
    EXPECT_EQ(test::drawing(mask_of(alone.best.regions, one)),
              test::drawing(mask_of(shared.best.regions, several)));
    ASSERT_EQ(alone.best.objects.size(), shared.best.objects.size());
    for (std::size_t i = 0; i < alone.best.objects.size(); ++i)
        EXPECT_EQ(alone.best.objects[i].confidence, shared.best.objects[i].confidence);
}

TEST(SeveralLimits, AreForThinPointsAndCoarseCells) {
    EXPECT_FALSE(needs_multi_threshold(0.5, 0));
    EXPECT_FALSE(needs_multi_threshold(1.5, 0.06));
    EXPECT_TRUE(needs_multi_threshold(0.5, 0.061));
    EXPECT_TRUE(needs_multi_threshold(1.999, 0));
}

TEST(SeveralLimits, FindARoughHouseOnCoarseCellsThatNoneIsWithoutAPoint) {
    // Rows and columns bend by so much, and every other diagonal by more. Up to 0.30 m is smooth enough for
    // the usual look, up to 0.42 m for the widest.
    const auto found = [](double bend) {
        Town town(30, 40, {2.5, 2.5});
        town.build([&](std::int32_t r, std::int32_t c) {
            const bool in = r >= 10 && r < 16 && c >= 14 && c < 20;
            return in ? 106 + static_cast<float>(bend / 2) * static_cast<float>(r % 2 + c % 2)
                      : test::unknown;
        });
        Context context;
        return detect_buildings(town.scene(), {}, min_area_m2, context).buildings;
    };
    EXPECT_EQ(found(0.1), 1);
    EXPECT_EQ(found(0.36), 1);
    EXPECT_EQ(found(0.6), 0);
}

}  // namespace
}  // namespace d2b

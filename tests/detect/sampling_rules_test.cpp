#include "detect/sampling_rules.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace d2b::detect {
namespace {

TEST(SamplingRules, ThinnessRisesFromUsualToThinPoints) {
    EXPECT_EQ(sparseness(0), 0);
    EXPECT_EQ(sparseness(0.04), 0);
    EXPECT_NEAR(sparseness(0.06), 0.5, 1e-12);
    EXPECT_EQ(sparseness(sparse_share()), 1);
    EXPECT_EQ(sparseness(1), 1);
    EXPECT_FALSE(has_sparse_points(sparse_share()));
    EXPECT_TRUE(has_sparse_points(0.081));
}

TEST(SamplingRules, MarginGrowsWithTheCellAndTheRootOfTheShare) {
    EXPECT_EQ(sampling_margin(2, 0.02), 0);
    EXPECT_EQ(sampling_margin(2, 0), 0);
    EXPECT_NEAR(sampling_margin(2, 0.27), 2 * 0.17 * 0.5, 1e-12);
    EXPECT_NEAR(sampling_margin(1, 0.27), 0.17 * 0.5, 1e-12);
}

TEST(SamplingRules, StrictLimitsAreForFineCells) {
    EXPECT_EQ(stricter_scales(1, 0), stricter_scales(1, 0.2));
    EXPECT_LT(stricter_scales(1.8, 0).back(), stricter_scales(1.99, 0).back());
    EXPECT_TRUE(stricter_scales(2, 0.2).empty()) << "thin scans of coarse cells need wide limits";
    EXPECT_LT(price_of_lost_roofs(0.2), price_of_lost_roofs(0));
}

}  // namespace
}  // namespace d2b::detect

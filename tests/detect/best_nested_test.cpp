#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "detect/detection_passes.hpp"

namespace d2b {
namespace {

constexpr std::size_t nothing = NestedCandidate::nothing;
using Choice = std::vector<bool>;

TEST(BestNested, TakesWhatGainsSomething) {
    const std::vector<NestedCandidate> apart{{2, nothing}, {-1, nothing}, {0, nothing}};
    EXPECT_EQ(max_weight_antichain(apart), (Choice{true, false, false}));
    EXPECT_TRUE(max_weight_antichain({}).empty());
}

TEST(BestNested, TakesTheInnerOnesWhereTogetherTheyGainAsMuch) {
    std::vector<NestedCandidate> two_in_one{{2, 2}, {4, 2}, {5, nothing}};
    EXPECT_EQ(max_weight_antichain(two_in_one), (Choice{true, true, false}));
    two_in_one[2].gain = 6;
    EXPECT_EQ(max_weight_antichain(two_in_one), (Choice{true, true, false}));
    two_in_one[2].gain = 7;
    EXPECT_EQ(max_weight_antichain(two_in_one), (Choice{false, false, true}));
}

TEST(BestNested, LooksThroughWhatGainsNothing) {
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

TEST(BestNested, HasTheLargestSumOfAllChoices) {
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

}  // namespace
}  // namespace d2b

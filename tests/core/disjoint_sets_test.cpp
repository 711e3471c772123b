#include "core/disjoint_sets.hpp"

#include <gtest/gtest.h>

namespace d2b {
namespace {

TEST(DisjointSets, TheSmallestStandsForThoseThatAreJoined) {
    DisjointSets sets(8);
    EXPECT_EQ(sets.join(7, 5), 5U);
    EXPECT_EQ(sets.join(5, 7), 5U);
    EXPECT_EQ(sets.join(2, 4), 2U);
    EXPECT_EQ(sets.join(4, 7), 2U);
    for (const std::uint32_t i : {2U, 4U, 5U, 7U})
        EXPECT_EQ(sets.find(i), 2U);
    for (const std::uint32_t i : {0U, 1U, 3U, 6U})
        EXPECT_EQ(sets.find(i), i);
}

TEST(DisjointSets, OneMayBeChosenToStandForBoth) {
    DisjointSets sets(3);
    sets.merge_roots(2, 0);
    EXPECT_EQ(sets.find(0), 2U);
    sets.merge_roots(1, 2);
    EXPECT_EQ(sets.find(0), 1U);
}

TEST(DisjointSets, ALongChainIsFollowedToItsEnd) {
    constexpr std::uint32_t count = 100000;
    DisjointSets sets(count);
    for (std::uint32_t i = 1; i < count; ++i)
        sets.merge_roots(i, i - 1);
    EXPECT_EQ(sets.find(0), count - 1);
    EXPECT_EQ(sets.find(count / 2), count - 1);
}

}  // namespace
}  // namespace d2b

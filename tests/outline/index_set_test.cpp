#include "outline/walls/index_set.hpp"

#include <random>
#include <set>

#include <gtest/gtest.h>

namespace d2b {
namespace {

TEST(IndexSet, TellsWhatASetTells) {
    for (const std::size_t limit : {1U, 63U, 64U, 65U, 4096U, 10000U}) {
        IndexSet set(limit);
        std::set<std::size_t> expected;
        std::mt19937 random(7);
        for (int i = 0; i < 3000; ++i) {
            const std::size_t at = random() % limit;
            if (random() % 3 == 0) {
                set.erase(at);
                expected.erase(at);
            } else if (expected.size() < 1 + limit / 100) {
                set.insert(at);
                expected.insert(at);
            }
            const std::size_t asked = random() % (limit + 1);
            const auto from = expected.lower_bound(asked);
            EXPECT_EQ(set.from(asked), from == expected.end() ? IndexSet::none : *from);
            EXPECT_EQ(set.before(asked), from == expected.begin() ? IndexSet::none : *std::prev(from));
        }
    }
}

}  // namespace
}  // namespace d2b

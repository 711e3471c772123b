#include <random>
#include <set>

#include <gtest/gtest.h>

#include "outline/walls/node_placement.hpp"

namespace d2b {
namespace {

TEST(OrderedBitset, TellsWhatASetTells) {
    for (const std::size_t limit : {1U, 63U, 64U, 65U, 4096U, 10000U}) {
        OrderedBitset set(limit);
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
            EXPECT_EQ(set.from(asked), from == expected.end() ? OrderedBitset::none : *from);
            EXPECT_EQ(set.before(asked), from == expected.begin() ? OrderedBitset::none : *std::prev(from));
        }
    }
}

}  // namespace
}  // namespace d2b

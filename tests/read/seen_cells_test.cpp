#include <random>

#include <gtest/gtest.h>

#include "read/band_reader.hpp"

namespace d2b {
namespace {

using Stretches = std::vector<std::pair<std::int32_t, std::int32_t>>;

Stretches added(RowCoverage& seen, std::int32_t row, std::int32_t begin, std::int32_t end) {
    Stretches some;
    seen.add(row, begin, end, [&](std::int32_t from, std::int32_t to) { some.emplace_back(from, to); });
    return some;
}

TEST(RowCoverage, AreNewOnce) {
    RowCoverage seen(3);
    EXPECT_EQ(added(seen, 1, 10, 20), (Stretches{{10, 20}}));
    EXPECT_EQ(added(seen, 1, 10, 20), Stretches{});
    EXPECT_EQ(added(seen, 2, 10, 20), (Stretches{{10, 20}}));
    EXPECT_EQ(added(seen, 1, 30, 40), (Stretches{{30, 40}}));
    EXPECT_EQ(added(seen, 1, 5, 45), (Stretches{{5, 10}, {20, 30}, {40, 45}}));
    EXPECT_EQ(added(seen, 1, 0, 50), (Stretches{{0, 5}, {45, 50}}));
    EXPECT_EQ(added(seen, 1, 50, 50), Stretches{});
    EXPECT_EQ(added(seen, 0, 3, 4), (Stretches{{3, 4}}));
}

TEST(RowCoverage, InAnyOrderEachCellIsNewOnce) {
    std::mt19937 random(3);
    RowCoverage seen(1);
    std::vector<bool> cells(200);
    for (int k = 0; k < 2000; ++k) {
        const auto begin = static_cast<std::int32_t>(random() % 200);
        const auto end = begin + static_cast<std::int32_t>(random() % 9);
        std::vector<bool> is_new(220);
        for (const auto& [from, to] : added(seen, 0, begin, std::min(end, 200)))
            for (std::int32_t i = from; i < to; ++i)
                is_new[static_cast<std::size_t>(i)] = true;
        for (std::size_t i = 0; i < 200; ++i) {
            const bool asked = static_cast<std::int32_t>(i) >= begin && static_cast<std::int32_t>(i) < end;
            ASSERT_EQ(is_new[i], asked && !cells[i]) << k << " " << i;
            cells[i] = cells[i] || asked;
        }
    }
}

}  // namespace
}  // namespace d2b

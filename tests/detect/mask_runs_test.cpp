#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "detect/regions.hpp"

namespace d2b {
namespace {

using Runs = std::vector<std::pair<std::int32_t, std::int32_t>>;

Runs runs_of(const std::vector<std::uint8_t>& row, std::uint8_t value) {
    Runs runs;
    for_mask_runs(row, value, [&](std::int32_t begin, std::int32_t end) { runs.emplace_back(begin, end); });
    return runs;
}

Runs runs_by_cell(const std::vector<std::uint8_t>& row, std::uint8_t value) {
    Runs runs;
    for (std::int32_t c = 0; c < static_cast<std::int32_t>(row.size()); ++c) {
        if (row[static_cast<std::size_t>(c)] != value)
            continue;
        if (runs.empty() || runs.back().second != c)
            runs.emplace_back(c, c);
        runs.back().second = c + 1;
    }
    return runs;
}

TEST(MaskRuns, EndWithTheRow) {
    EXPECT_EQ(runs_of({}, 1), Runs());
    EXPECT_EQ(runs_of({1}, 1), (Runs{{0, 1}}));
    EXPECT_EQ(runs_of({1}, 0), Runs());
    for (const std::int32_t cols : {63, 64, 65, 128, 200}) {
        const std::vector<std::uint8_t> row(static_cast<std::size_t>(cols), 1);
        EXPECT_EQ(runs_of(row, 1), (Runs{{0, cols}}));
        EXPECT_EQ(runs_of(row, 0), Runs());
    }
}

TEST(MaskRuns, AreThoseOfCellAfterCell) {
    std::mt19937 random(11);  // NOLINT: the same rows in every run
    for (const std::size_t cols : {1U, 7U, 8U, 9U, 63U, 64U, 65U, 127U, 128U, 129U, 1000U})
        for (const double share : {0.02, 0.5, 0.98}) {
            std::bernoulli_distribution is(share);
            std::vector<std::uint8_t> row(cols);
            for (std::uint8_t& cell : row)
                cell = is(random) ? 1 : 0;
            for (const std::uint8_t value : {std::uint8_t{0}, std::uint8_t{1}})
                EXPECT_EQ(runs_of(row, value), runs_by_cell(row, value)) << cols << " " << share;
        }
}

}  // namespace
}  // namespace d2b

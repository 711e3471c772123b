#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/band.hpp"

namespace d2b {
namespace {

TEST(RowSlabs, aBandSeesWhatWasPutIntoItsRows) {
    constexpr std::int32_t first = 1000;
    constexpr std::int32_t rows = 300;
    RowSlabs<std::vector<std::int32_t>> slabs(first, rows);
    for (std::int32_t row = first; row < first + rows; ++row)
        slabs[slabs.index(row)].push_back(row);
    for (const BandShape band :
         {BandShape{first, rows, 1}, {first, 1, 1}, {1063, 2, 1}, {1128, 64, 1}, {first + rows - 1, 1, 1}}) {
        std::vector<std::int32_t> seen;
        slabs.for_band(band, [&](const auto& rows_of_slab) {
            seen.insert(seen.end(), rows_of_slab.begin(), rows_of_slab.end());
        });
        EXPECT_TRUE(std::ranges::is_sorted(seen));
        EXPECT_EQ(
            std::ranges::count_if(
                seen, [&](auto row) { return row >= band.first_row && row < band.first_row + band.rows; }),
            band.rows);
    }
}

TEST(RowSlabs, aBandWithoutRowsSeesNothing) {
    const RowSlabs<int> slabs(7, 0);
    slabs.for_band({7, 0, 5}, [](int) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace d2b

#include "core/band.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/grid.hpp"

namespace d2b {
namespace {

TEST(RowBands, CoverAGridFromItsFirstRowToItsLast) {
    for (const std::int32_t cols : {0, 1, 5000, 1 << 24}) {
        std::int32_t next = 0;
        for (const RowBand& band : row_bands(3001, cols)) {
            EXPECT_EQ(band.begin, next);
            EXPECT_GT(band.end, band.begin);
            next = band.end;
        }
        EXPECT_EQ(next, 3001);
    }
    EXPECT_TRUE(row_bands(0, 7).empty());
}

class BandCopies : public testing::TestWithParam<int> {};

/// Each cell becomes the sum of the cells up to two rows above and below, as they were.
TEST_P(BandCopies, HoldRowsAsTheyWereWhileTheGridIsChanged) {
    constexpr std::int32_t cols = 60000, rows = 61, reach = 2;  // bands of sixteen rows
    Grid<int> grid(rows, cols), expected = grid;
    for (std::size_t k = 0; k < grid.size(); ++k)
        grid.values[k] = static_cast<int>(k * k % 1009);
    for (std::int32_t i = 0; i < rows; ++i)
        for (std::int32_t y = std::max(i - reach, 0); y <= std::min(i + reach, rows - 1); ++y)
            for (std::int32_t j = 0; j < cols; ++j)
                expected.at(i, j) += grid.at(y, j);
    Executor threads(GetParam());
    for_bands_with_halo(threads, grid, reach, [&](const HaloBand<int>& old) {
        for (std::int32_t i = old.band.begin; i < old.band.end; ++i) {
            std::fill(grid.row(i).begin(), grid.row(i).end(), 0);
            for (std::int32_t y = std::max(i - reach, 0); y <= std::min(i + reach, rows - 1); ++y)
                for (std::int32_t j = 0; j < cols; ++j)
                    grid.at(i, j) += old.rows.at(y - old.first, j);
        }
    });
    EXPECT_EQ(grid.values, expected.values);
}

TEST_P(BandCopies, GoBackIntoTheGridWithoutTheRowsAround) {
    Grid<int> grid(40, 1 << 16, 5);
    Executor threads(GetParam());
    for_bands_with_halo(threads, grid, 3, [&](HaloBand<int>& copy) {
        for (std::int32_t i = 0; i < copy.rows.rows; ++i) {
            const std::int32_t row = copy.first + i;
            const bool around = row < copy.band.begin || row >= copy.band.end;
            std::fill(copy.rows.row(i).begin(), copy.rows.row(i).end(), around ? -1 : row);
        }
        copy.write_band(grid);
    });
    for (std::int32_t i = 0; i < grid.rows; ++i)
        for (const int value : grid.row(i))
            ASSERT_EQ(value, i);
}

TEST_P(BandCopies, EachThreadHasARoomOfItsOwn) {
    struct Room {
        std::atomic<int> inside = 0;
    };
    Executor threads(GetParam());
    std::atomic<int> done = 0;
    threads.for_each_with_scratch<Room>(2000, [&](std::size_t, Room& room) {
        EXPECT_EQ(++room.inside, 1);
        ++done;
        --room.inside;
    });
    EXPECT_EQ(done, 2000);
}

INSTANTIATE_TEST_SUITE_P(Threads, BandCopies, testing::Values(1, 2, 5));

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

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "detect/units.hpp"

namespace d2b {
namespace {

/// Of an axis: the stretches that units own and see, from the borders of their windows.
struct Stretch {
    std::int32_t begin;
    std::int32_t end;
    friend bool operator==(const Stretch&, const Stretch&) = default;
};

std::vector<Stretch> rows_seen(const UnitGrid& units) {
    std::vector<Stretch> rows;
    for (std::int32_t row = 0; row < units.rows(); ++row)
        rows.push_back({units.unit(row, 0).seen.row, units.unit(row, 0).seen.end_row()});
    return rows;
}
std::vector<Stretch> cols_seen(const UnitGrid& units) {
    std::vector<Stretch> cols;
    for (std::int32_t col = 0; col < units.cols(); ++col)
        cols.push_back({units.unit(0, col).seen.col, units.unit(0, col).seen.end_col()});
    return cols;
}

/// Cells that all units see, for each cell of the window.
double seen_share(const UnitGrid& units, const Window& window) {
    double down = 0;
    double across = 0;
    for (const auto& [begin, end] : rows_seen(units))
        down += end - begin;
    for (const auto& [begin, end] : cols_seen(units))
        across += end - begin;
    return down / window.rows * (across / window.cols);
}

TEST(UnitGrid, ASmallWindowIsOne) {
    const Window window{100, 7, 1000, 2000};
    const UnitGrid units(window, {1, 1}, 300, {2'000'000, 10});
    ASSERT_EQ(units.count(), 1);
    EXPECT_EQ(units.unit(0, 0).own, window);
    EXPECT_EQ(units.unit(0, 0).seen, window);
    EXPECT_EQ(units.most_seen(), 2'000'000);
}

TEST(UnitGrid, SixtyFourMillionPointsAreOne) {
    EXPECT_EQ(UnitGrid({0, 0, 8192, 8192}, {1, 1}, 300).count(), 1);
    EXPECT_EQ(UnitGrid({0, 0, 1 << 26, 1}, {1, 1}, 300).count(), 1);
    const UnitGrid units({0, 0, 8192, 8193}, {1, 1}, 300);
    EXPECT_EQ(units.rows(), 2);
    EXPECT_EQ(units.cols(), 2);
}

TEST(UnitGrid, CoversTheWindowAndSeesMore) {
    // 2,101 rows in units of at most 600 are four; 300 m are 150 rows and 75 columns of these cells.
    const UnitGrid units({50, 20, 2101, 700}, {4, 2}, 300, {1'000'000, 600});
    ASSERT_EQ(units.rows(), 4);
    ASSERT_EQ(units.cols(), 2);
    std::int32_t row = 50;
    for (std::int32_t i = 0; i < 4; ++i) {
        std::int32_t col = 20;
        for (std::int32_t j = 0; j < 2; ++j) {
            const auto [own, seen] = units.unit(i, j);
            EXPECT_EQ(own.row, row);
            EXPECT_EQ(own.col, col);
            EXPECT_TRUE(own.rows == 525 || own.rows == 526);
            EXPECT_EQ(own.cols, 350);
            EXPECT_EQ(seen.row, std::max(own.row - 150, 50));
            EXPECT_EQ(seen.end_row(), std::min(own.end_row() + 150, 2151));
            EXPECT_EQ(seen.col, std::max(own.col - 75, 20));
            EXPECT_EQ(seen.end_col(), std::min(own.end_col() + 75, 720));
            col = own.end_col();
        }
        EXPECT_EQ(col, 720);
        row = units.unit(i, 0).own.end_row();
    }
    EXPECT_EQ(row, 2151);
    EXPECT_EQ(units.most_seen(), (525 + 2 * 150) * (350 + 75));
}

TEST(UnitGrid, SeesSomeCellsAroundHoweverLargeTheyAre) {
    const UnitGrid units({0, 0, 640, 40}, {1000, 1000}, 300, {0, 300});
    EXPECT_EQ(rows_seen(units), (std::vector<Stretch>{{0, 277}, {149, 490}, {362, 640}}));
    EXPECT_EQ(cols_seen(units), (std::vector<Stretch>{{0, 40}}));
    // And no more than there are.
    EXPECT_EQ(rows_seen(UnitGrid({0, 0, 640, 40}, {1, 1}, 1e9, {0, 300})),
              (std::vector<Stretch>{{0, 640}, {0, 640}, {0, 640}}));
}

TEST(UnitGrid, SeesLittleMoreThanThereIsWhateverTheShape) {
    // Of 100 million points and more; the columns of units of every number, just divided or nearly again.
    for (const std::int32_t cols :
         {1, 700, 1722, 6144, 6145, 8300, 10000, 12288, 12289, 40000, 100000, 316228})
        for (const std::int64_t points : {100'000'000LL, 100'010'000LL, 1'000'000'000LL, 100'000'000'000LL}) {
            const std::int64_t rows = (points + cols - 1) / cols;
            if (rows > 2'000'000'000)
                continue;
            const Window window{0, 0, static_cast<std::int32_t>(rows), cols};
            const UnitGrid metre(window, {1, 1}, 300);
            EXPECT_LE(seen_share(metre, window), 1.25) << rows << " x " << cols;
            EXPECT_LE(metre.most_seen(), std::int64_t{48} << 20);
            EXPECT_LE(seen_share(UnitGrid(window, {0.5, 0.5}, 300), window), 1.5) << rows << " x " << cols;
            for (const std::int32_t row : {0, metre.rows() - 1})
                for (const std::int32_t col : {0, metre.cols() - 1}) {
                    const Window own = metre.unit(row, col).own;
                    EXPECT_GE(own.rows, std::min(window.rows, 1024));
                    EXPECT_GE(own.cols, std::min(window.cols, 1024));
                    EXPECT_LE(std::max(own.rows, own.cols), 6144);
                }
        }
}

TEST(UnitGrid, GoesToTheLastRowOfTheLargestRaster) {
    const UnitGrid units({0, 0, 2147483647, 1}, {1, 1}, 300);
    EXPECT_EQ(units.unit(units.rows() - 1, 0).own.end_row(), 2147483647);
    EXPECT_EQ(units.unit(units.rows() - 1, 0).seen.end_row(), 2147483647);
}

}  // namespace
}  // namespace d2b

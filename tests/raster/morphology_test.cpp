#include "raster/morphology.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "support/masks.hpp"
#include "support/test_threads.hpp"

namespace d2b::test {
namespace {

using Offsets = std::vector<std::pair<std::int32_t, std::int32_t>>;  // rows down, columns to the right

Offsets offsets_within(double radius, const CellSize& cell) {
    if (radius < cell.across || radius < cell.down)
        return {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
    Offsets result;
    for (std::int32_t r = -40; r <= 40; ++r)
        for (std::int32_t c = -40; c <= 40; ++c)
            if (r * r * cell.down * cell.down + c * c * cell.across * cell.across <= radius * radius + 1e-6)
                result.emplace_back(r, c);
    return result;
}

/// Cells for which `chosen` holds at all offsets; beyond the border are the nearest cells.
Mask where_all(const Mask& mask, const Offsets& offsets, int sign, std::uint8_t value) {
    Mask result(mask.rows, mask.cols);
    for (std::int32_t r = 0; r < mask.rows; ++r)
        for (std::int32_t c = 0; c < mask.cols; ++c) {
            bool all = true;
            for (const auto& [down, right] : offsets)
                all = all && mask.at(std::clamp(r + sign * down, 0, mask.rows - 1),
                                     std::clamp(c + sign * right, 0, mask.cols - 1)) == value;
            result.at(r, c) = all ? 1 : 0;
        }
    return result;
}

Mask opened_by_definition(const Mask& mask, double radius, const CellSize& cell) {
    const Offsets offsets = offsets_within(radius, cell);
    Mask result = where_all(where_all(mask, offsets, 1, 1), offsets, -1, 0);
    for (std::uint8_t& value : result.values)
        value ^= 1;
    return result;
}

TEST(Morphology, OpenedAndErodedByDefinition) {
    std::mt19937 random(5);
    const std::vector<CellSize> sizes{{1, 1}, {0.5, 0.5}, {0.5, 1}, {1, 0.4}, {2, 2}, {1, 1.6}, {0.3, 0.25}};
    for (unsigned i = 0; i < 210; ++i) {
        const auto rows = static_cast<std::int32_t>(1 + random() % 30);
        const auto cols = static_cast<std::int32_t>(1 + random() % 40);
        const Mask mask =
            i % 3 == 0 ? random_mask(rows, cols, 95, random) : random_blocks(rows, cols, 30, random);
        const CellSize& cell = sizes[i % sizes.size()];
        for (const double radius : {1.5, 3.0, 1.0}) {
            ASSERT_EQ(drawing(open_mask(mask, radius, cell, threads())),
                      drawing(opened_by_definition(mask, radius, cell)))
                << i << " radius " << radius;
            ASSERT_EQ(drawing(erode(mask, radius, cell, threads())),
                      drawing(where_all(mask, offsets_within(radius, cell), 1, 1)))
                << i << " radius " << radius;
        }
    }
}

TEST(Morphology, DilatedByDefinition) {
    std::mt19937 random(7);
    for (std::int32_t reach = 0; reach < 5; ++reach)
        for (int i = 0; i < 20; ++i) {
            const auto rows = static_cast<std::int32_t>(1 + random() % 20);
            const auto cols = static_cast<std::int32_t>(1 + random() % 20);
            const Mask mask = random_mask(rows, cols, 5, random);
            Mask expected(rows, cols);
            for (std::int32_t r = 0; r < rows; ++r)
                for (std::int32_t c = 0; c < cols; ++c)
                    for (std::int32_t down = -reach; down <= reach; ++down)
                        for (std::int32_t right = -reach; right <= reach; ++right)
                            if (mask.holds(r + down, c + right) && mask.at(r + down, c + right) != 0)
                                expected.at(r, c) = 1;
            ASSERT_EQ(drawing(dilate(mask, reach)), drawing(expected)) << reach;
        }
}

TEST(Morphology, OpeningCutsBridgesAndKeepsHouses) {
    const Mask mask = drawn({"..........",  //
                             ".####.####",  //
                             ".#########",  //
                             ".####.####",  //
                             ".####.####",  //
                             ".....#....",  //
                             ".....#...."});
    EXPECT_EQ(drawing(open_mask(mask, 1.5, {1, 1}, threads())), drawing(drawn({"..........",  //
                                                                               ".####.####",  //
                                                                               ".####.####",  //
                                                                               ".####.####",  //
                                                                               ".####.####",  //
                                                                               "..........",  //
                                                                               ".........."})));
    // Two by two cells where a cell is larger than the radius.
    EXPECT_EQ(drawing(open_mask(drawn({"###.", "##..", "...#", "..##"}), 1.5, {2, 2}, threads())),
              drawing(drawn({"##..", "##..", "...#", "..##"})))
        << "the corner continues beyond the border";
    EXPECT_EQ(open_mask(Mask(), 1.5, {1, 1}, threads()).size(), 0U);
}

TEST(Morphology, GrownByNeighbours) {
    std::mt19937 random(6);
    for (int i = 0; i < 100; ++i) {
        const auto rows = static_cast<std::int32_t>(1 + random() % 20);
        const auto cols = static_cast<std::int32_t>(1 + random() % 40);
        const Mask within = random_mask(rows, cols, 70, random);
        const Mask mask = random_mask(rows, cols, 10, random);
        Mask expected = mask;
        for (int step = 0; step < 3; ++step) {
            ASSERT_EQ(drawing(dilate_within(mask, within, step, threads())), drawing(expected))
                << i << " step " << step;
            Mask next = expected;
            for (std::int32_t r = 0; r < rows; ++r)
                for (std::int32_t c = 0; c < cols; ++c)
                    for (const auto& [y, x] : {std::pair{r - 1, c}, {r + 1, c}, {r, c - 1}, {r, c + 1}})
                        if (expected.holds(y, x) && expected.at(y, x) != 0 && within.at(r, c) != 0)
                            next.at(r, c) = 1;
            expected = next;
        }
    }
}

/// Sums over neighbourhoods from sums over all that is above and to the left.
class Counts {
  public:
    explicit Counts(const Mask& mask) : mask_(mask), sums_(mask.rows + 1, mask.cols + 1) {
        for (std::int32_t r = 0; r < mask.rows; ++r)
            for (std::int32_t c = 0; c < mask.cols; ++c)
                sums_.at(r + 1, c + 1) =
                    mask.at(r, c) + sums_.at(r, c + 1) + sums_.at(r + 1, c) - sums_.at(r, c);
    }
    [[nodiscard]] int around(std::int32_t r, std::int32_t c, std::int32_t up, std::int32_t side) const {
        const std::int32_t top = std::max(r - up, 0);
        const std::int32_t left = std::max(c - side, 0);
        const std::int32_t bottom = std::min(r + up + 1, mask_.rows);
        const std::int32_t right = std::min(c + side + 1, mask_.cols);
        return sums_.at(bottom, right) - sums_.at(top, right) - sums_.at(bottom, left) + sums_.at(top, left);
    }

  private:
    const Mask& mask_;
    Grid<int> sums_;
};

Mask reference(Mask now, const Mask& elevated, std::int32_t up, std::int32_t side) {
    for (int round = 0; round < 2; ++round) {
        Mask next(now.rows, now.cols);
        const Counts buildings(now);
        const Counts all(elevated);
        for (std::int32_t r = 0; r < now.rows; ++r)
            for (std::int32_t c = 0; c < now.cols; ++c) {
                const int least = now.at(r, c) != 0 ? 10 : 58;
                if (elevated.at(r, c) != 0 &&
                    100 * buildings.around(r, c, up, side) > least * all.around(r, c, up, side))
                    next.at(r, c) = 1;
            }
        now = next;
    }
    return now;
}

/// Neighbourhoods reach 3.5 m, and one cell at least.
std::int32_t growth_reach(double step) {
    return std::max(1, static_cast<std::int32_t>(std::lround(3.5 / step)));
}

void expect_like_reference(std::int32_t rows, std::int32_t cols, const CellSize& cell, std::mt19937& random) {
    const Mask elevated = random_mask(rows, cols, 70, random);
    Mask seeds = random_blocks(rows, cols, rows * cols / 20 + 1, random);
    for (std::size_t i = 0; i < seeds.size(); ++i)
        seeds.values[i] &= elevated.values[i];
    ASSERT_EQ(drawing(grow_by_majority(seeds, elevated, cell, threads())),
              drawing(reference(seeds, elevated, growth_reach(cell.down), growth_reach(cell.across))))
        << rows << " x " << cols << " of " << cell.across << " x " << cell.down;
}

TEST(Majority, LikeCountingWindowByWindow) {
    std::mt19937 random(3);
    for (int i = 0; i < 40; ++i) {
        const auto rows = static_cast<std::int32_t>(1 + random() % 50);
        const auto cols = static_cast<std::int32_t>(1 + random() % 50);
        expect_like_reference(rows, cols, {1, 1}, random);
        expect_like_reference(rows, cols, {0.5, 0.5}, random);
        expect_like_reference(rows, cols, {0.5, 2}, random);
        expect_like_reference(rows, cols, {5, 5}, random);
        expect_like_reference(rows, cols, {20, 1.4}, random);      // 2.5 cells round up, 0.175 to one
        expect_like_reference(rows, cols, {0.4375, 0.5}, random);  // windows of 255 cells
        expect_like_reference(rows, cols, {0.3, 0.3}, random);     // and of 625
    }
}

TEST(Majority, WindowsOfManyCells) {
    std::mt19937 random(4);
    // 351 by 351 cells are more than 65535.
    expect_like_reference(150, 280, {0.02, 0.02}, random);
    expect_like_reference(280, 150, {0.02, 0.02}, random);
}

TEST(Majority, SharesAreExceededNotReached) {
    // One row and neighbourhoods of all of its 50 cells: 29 of 50 are 58 %, 5 of 50 are 10 %.
    const Mask elevated(1, 50, 1);
    const CellSize cell{0.05, 4};
    const auto first = [](std::int32_t n) {
        Mask mask(1, 50);
        std::fill_n(mask.values.begin(), n, std::uint8_t{1});
        return mask;
    };
    EXPECT_EQ(drawing(grow_by_majority(first(5), elevated, cell, threads())), drawing(first(0)));
    EXPECT_EQ(drawing(grow_by_majority(first(6), elevated, cell, threads())), drawing(first(6)));
    EXPECT_EQ(drawing(grow_by_majority(first(29), elevated, cell, threads())), drawing(first(29)));
    EXPECT_EQ(drawing(grow_by_majority(first(30), elevated, cell, threads())), drawing(elevated));
    EXPECT_EQ(grow_by_majority(Mask(), Mask(), cell, threads()).size(), 0U);
}

/// Cell by cell: more than half of the neighbourhood's cells that there are, and within.
Mask voted_border(const Mask& mask, const Mask& within, std::int32_t up, std::int32_t side) {
    Mask result(mask.rows, mask.cols);
    for (std::int32_t r = 0; r < mask.rows; ++r)
        for (std::int32_t c = 0; c < mask.cols; ++c) {
            int votes = 0;
            for (std::int32_t y = r - up; y <= r + up; ++y)
                for (std::int32_t x = c - side; x <= c + side; ++x)
                    votes += !mask.holds(y, x) ? 0 : mask.at(y, x) != 0 ? 1 : -1;
            result.at(r, c) = votes > 0 && within.at(r, c) != 0 ? 1 : 0;
        }
    return result;
}

TEST(SmoothBorder, LikeVotingCellByCell) {
    struct Window {
        CellSize cell;
        std::int32_t up, side;
    };
    const std::vector<Window> windows{
        {{1, 1}, 1, 1},      {{0.5, 0.5}, 2, 2}, {{0.5, 2}, 1, 2},  // half a cell rounds up
        {{0.7, 0.3}, 3, 1},                                         // 3.33 and 1.43 cells
        {{5, 5}, 1, 1},                                             // one cell at least
        {{0.2, 0.25}, 4, 5},
    };
    std::mt19937 random(11);
    for (int i = 0; i < 40; ++i)
        for (const Window& window : windows) {
            const auto rows = static_cast<std::int32_t>(1 + random() % 30);
            const auto cols = static_cast<std::int32_t>(1 + random() % 40);
            const Mask mask = i % 2 == 0 ? random_blocks(rows, cols, rows * cols / 20 + 1, random)
                                         : random_mask(rows, cols, 50, random);
            const Mask within = random_mask(rows, cols, 80, random);
            ASSERT_EQ(drawing(smooth_border(mask, within, window.cell, threads())),
                      drawing(voted_border(mask, within, window.up, window.side)))
                << rows << " x " << cols << " of " << window.cell.across << " x " << window.cell.down;
        }
}

TEST(SmoothBorder, CornersGoNotchesFillWhereTheyMay) {
    const Mask mask = drawn({".........",  //
                             ".####....",  //
                             ".####....",  //
                             ".#######.",  //
                             ".#######.",  //
                             ".###.###.",  //
                             "........."});
    // Outer corners have four of nine, the inner corner and the notch five.
    EXPECT_EQ(drawing(smooth_border(mask, Mask(7, 9, 1), {1, 1}, threads())),
              drawing(drawn({".........",  //
                             "..##.....",  //
                             ".#####...",  //
                             ".######..",  //
                             ".#######.",  //
                             "..#####..",  //
                             "........."})));
}

TEST(SmoothBorder, BeyondTheRasterNobodyVotes) {
    const auto smoothed = [](const std::string& row) {
        const Mask mask = drawn({row});
        return drawing(smooth_border(mask, Mask(1, mask.cols, 1), {1, 1}, threads()))[0];
    };
    EXPECT_EQ(smoothed("##."), "##.");
    EXPECT_EQ(smoothed("#."), "..") << "half is not most";
    EXPECT_EQ(smoothed("#"), "#");
    const Mask all(3, 4, 1);
    EXPECT_EQ(drawing(smooth_border(all, all, {1, 1}, threads())), drawing(all));
    EXPECT_EQ(smooth_border(Mask(), Mask(), {1, 1}, threads()).size(), 0U);
}

TEST(SmoothBorder, WindowsOfManyCells) {
    // Neighbourhoods reach 250 cells to each side: they hold more than 65535. Columns 30 to 249 see all 280
    // columns, and 141 of them are a building. Those before see fewer of the others; column c behind sees 391
    // - c of 530 - c, more than half up to column 251.
    const auto first = [](std::int32_t cols) {
        Mask mask(300, 280);
        for (std::int32_t r = 0; r < mask.rows; ++r)
            std::fill_n(mask.row(r).begin(), cols, std::uint8_t{1});
        return mask;
    };
    const Mask anywhere(300, 280, 1);
    EXPECT_EQ(smooth_border(first(141), anywhere, {0.004, 0.004}, threads()).values, first(252).values);
    EXPECT_EQ(smooth_border(first(280), anywhere, {0.004, 0.004}, threads()).values, anywhere.values);
}

}  // namespace
}  // namespace d2b::test

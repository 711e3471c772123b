#pragma once

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

#include "pipeline/made_town.hpp"

namespace d2b::test {

/// Blocks with flat roofs on ground that rises, on cells of a metre. Every point is off by a few centimetres.
struct BlockTown {
    BlockTown(int row_count, int col_count) : rows(row_count), cols(col_count) {
        std::mt19937 random(11);
        for (int r = 0; r < rows; ++r)
            for (int c = 0; c < cols; ++c) {
                noise.push_back(static_cast<double>(random() % 60) / 1000);
                z.push_back(ground(r, c) + noise.back());
            }
    }

    [[nodiscard]] static double ground(double row, double col) { return 100 + 0.004 * col + 0.01 * row; }
    [[nodiscard]] std::size_t index(int row, int col) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(col);
    }
    /// @param height above the ground at the box's first cell
    void build(const Box& box, double height) {
        for (int r = box.row; r < std::min(rows, box.row + box.rows); ++r)
            for (int c = box.col; c < std::min(cols, box.col + box.cols); ++c)
                z[index(r, c)] = ground(box.row, box.col) + height + noise[index(r, c)];
    }
    [[nodiscard]] MemorySource source() const { return {rows, cols, z}; }
    [[nodiscard]] MemorySource on_grid(const std::function<double(int, int)>& value) const {
        std::vector<double> values;
        for (int r = 0; r < rows; ++r)
            for (int c = 0; c < cols; ++c)
                values.push_back(value(r, c));
        return {rows, cols, std::move(values)};
    }

    /// 420 to 479 x 360 to 439 cells: blocks in plots of 60 x 60, some of them wings beside each other, over
    /// the plots' borders here and there, and some cells without a value.
    [[nodiscard]] static BlockTown random(unsigned seed) {
        std::mt19937 random(seed);
        const auto from = [&](int low, int high) {
            return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
        };
        BlockTown town(from(420, 479), from(360, 439));
        for (int row = 0; row + 60 <= town.rows; row += 60)
            for (int col = 0; col + 60 <= town.cols; col += 60) {
                const Box block{row + from(3, 12), col + from(3, 12), from(10, 34), from(10, 34)};
                const double height = from(4, 9);
                town.build(block, height);
                if (from(0, 2) == 0)  // a wing that touches it
                    town.build({block.row + block.rows, block.col, from(8, 18), block.cols}, height + 5);
            }
        for (int k = 0; k < 30; ++k)
            town.z[town.index(from(0, town.rows - 1), from(0, town.cols - 1))] = std::nan("");
        return town;
    }

    int rows;
    int cols;
    std::vector<double> noise;
    std::vector<double> z;
};

}  // namespace d2b::test

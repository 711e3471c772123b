#include <algorithm>

#include <gtest/gtest.h>

#include "detect/candidates.hpp"

namespace d2b {
namespace {

/// A block of 10 m, 8 x 8 cells in the middle of 12 x 12, with a border of another height.
struct Block {
    explicit Block(float border) {
        surface = MetreGrid(12, 12);
        terrain = MetreGrid(12, 12);
        cells = Mask(12, 12);
        for (std::int32_t row = 2; row < 10; ++row)
            for (std::int32_t col = 2; col < 10; ++col) {
                const bool inner = row > 2 && row < 9 && col > 2 && col < 9;
                surface.values[surface.index(row, col)] = inner ? 10 : border;
                cells.values[cells.index(row, col)] = 1;
            }
    }
    [[nodiscard]] std::int64_t left() {
        Executor threads(2);
        remove_blurred_edge({surface, terrain, {1, 1}}, cells, threads);
        return std::count(cells.values.begin(), cells.values.end(), 1);
    }
    MetreGrid surface;
    MetreGrid terrain;
    Mask cells;
};

TEST(SmearedBorder, IsTakenOffBelowHalfTheHeightBesideIt) {
    EXPECT_EQ(Block(4.9F).left(), 36);
    EXPECT_EQ(Block(5.1F).left(), 64);
}

TEST(SmearedBorder, OneCellAloneIsTakenOff) {
    Block block(10);
    block.surface.values[block.surface.index(5, 2)] = 3;
    EXPECT_EQ(block.left(), 63);
    EXPECT_EQ(block.cells.values[block.cells.index(5, 2)], 0);
}

TEST(SmearedBorder, WhatHasNoInsideKeepsItsBorder) {
    Block block(3);
    for (std::int32_t row = 0; row < 12; ++row)
        for (std::int32_t col = 0; col < 12; ++col)
            if (row > 3)
                block.cells.values[block.cells.index(row, col)] = 0;
    EXPECT_EQ(block.left(), 16);  // two rows of eight
}

}  // namespace
}  // namespace d2b

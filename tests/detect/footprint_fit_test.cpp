#include "detect/footprint_fit.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/executor.hpp"
#include "raster/row_spans.hpp"

namespace d2b::detect {
namespace {

struct Rectangle {
    int row;
    int col;
    int rows;
    int cols;

    template <typename T>
    void fill(Grid<T>& grid, T value) const {
        for (int r = row; r < row + rows; ++r)
            for (int c = col; c < col + cols; ++c)
                grid.at(r, c) = value;
    }
};

/// Flat ground of 40 x 60 cells with a block on it, and a footprint.
class FootprintFit : public ::testing::Test {
  protected:
    /// @param cell side of a cell in m
    [[nodiscard]] static double shift(const Rectangle& block, const Rectangle& footprint, double cell = 1) {
        MetreGrid surface(40, 60, 100.0F);
        block.fill(surface, 108.0F);
        const MetreGrid terrain(40, 60, 100.0F);
        Grid<Label> labels(40, 60, 0);
        footprint.fill(labels, Label{3});
        std::vector<RowSpan> runs;
        for (int r = footprint.row; r < footprint.row + footprint.rows; ++r)
            runs.push_back({r, footprint.col, footprint.col + footprint.cols});
        return wall_shift({surface, terrain, {cell, cell}}, labels, 3, runs, 2);
    }
};

TEST_F(FootprintFit, findsTheWalls) {
    const Rectangle block{10, 20, 10, 14};
    EXPECT_EQ(shift(block, block), 0);
    EXPECT_EQ(shift(block, {10, 21, 10, 14}), 1);
    EXPECT_DOUBLE_EQ(shift(block, {12, 17, 10, 14}), std::hypot(2, 3));
    EXPECT_DOUBLE_EQ(shift(block, {12, 17, 10, 14}, 0.5), std::hypot(1, 1.5));
}

/// Such is the footprint of a roof that juts out.
TEST_F(FootprintFit, letsSmallerFootprintsStay) {
    EXPECT_EQ(shift({10, 20, 10, 14}, {11, 21, 8, 12}), 0);
    EXPECT_EQ(shift({10, 20, 10, 14}, {9, 19, 12, 16}), 0);
}

/// A house in a row fits anywhere along it.
TEST_F(FootprintFit, letsHousesInARowStay) {
    EXPECT_EQ(shift({10, 5, 10, 50}, {10, 26, 10, 8}), 0);
    EXPECT_EQ(shift({10, 5, 10, 50}, {12, 26, 10, 8}), 2);
}

TEST_F(FootprintFit, doesNotReachFurtherThanHalfTheFootprint) {
    EXPECT_EQ(shift({10, 20, 4, 4}, {10, 30, 4, 4}), 0);
    EXPECT_LE(shift({10, 20, 4, 4}, {10, 23, 4, 4}), 2);
}

}  // namespace
}  // namespace d2b::detect

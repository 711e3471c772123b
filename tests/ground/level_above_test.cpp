#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "ground/gap_filling.hpp"
#include "ground/random_surface.hpp"
#include "support/test_threads.hpp"

namespace d2b::ground {
namespace {

/// Cell by cell, by the places of centres; bit by bit, since nothing else is added up.
TEST(CoarserLevel, FillsGapsBetweenTheCentresOfItsBlocks) {
    for (std::int32_t cols = 1; cols < 24; ++cols)
        for (const std::int32_t first_col : {-3, -2, 0, 5}) {
            AlignedGrid fine;
            fine.first_row = cols % 4 - 2;
            fine.first_col = first_col;
            fine.grid = test::random_surface(static_cast<unsigned>(cols), 7, cols, 2);
            AlignedGrid coarse = blocks_of(fine, twice, 0.0F, test::threads());
            for (std::size_t k = 0; k < coarse.grid.size(); ++k)
                coarse.grid.values[k] = static_cast<float>(k * k % 37) / 7.0F;
            const InterpolationWeights down(fine.first_row, 7, coarse.first_row, coarse.grid.rows, 2);
            const InterpolationWeights across(fine.first_col, cols, coarse.first_col, coarse.grid.cols, 2);
            const CoarserLevel above(fine, coarse);
            CoarserLevel::Buffers room;
            for (std::int32_t i = 0; i < 7; ++i) {
                std::vector<std::uint8_t> gap;
                std::vector<float> expected;
                for (std::int32_t j = 0; j < cols; ++j) {
                    gap.push_back((i + j) % 3 == 0 ? 1 : 0);
                    const auto block = [&](std::int32_t col) {
                        const float a = coarse.grid.at(down[i].near, col);
                        return a + down[i].share * (coarse.grid.at(down[i].next, col) - a);
                    };
                    const float a = block(across[j].near);
                    const float between = a + across[j].share * (block(across[j].next) - a);
                    expected.push_back(gap.back() != 0 ? between : fine.grid.at(i, j));
                }
                std::vector<float> cells(fine.grid.row(i).begin(), fine.grid.row(i).end());
                above.fill_row(i, gap, room, cells);
                EXPECT_EQ(cells, expected) << cols << " " << first_col << " " << i;
            }
        }
}

}  // namespace
}  // namespace d2b::ground

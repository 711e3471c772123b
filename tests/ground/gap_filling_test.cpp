#include "ground/gap_filling.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "support/random_surface.hpp"
#include "support/test_threads.hpp"

namespace d2b::ground {
namespace {

AlignedGrid plane(std::int32_t rows, std::int32_t cols, float down, float across) {
    AlignedGrid surface;
    surface.grid = MetreGrid(rows, cols);
    for (std::int32_t i = 0; i < rows; ++i)
        for (std::int32_t j = 0; j < cols; ++j)
            surface.grid.at(i, j) = down * static_cast<float>(i) + across * static_cast<float>(j);
    return surface;
}

void fill(AlignedGrid& surface, int relaxations) {
    Pyramid pyramid;
    fill_gaps(surface, relaxations, pyramid, test::threads());
}

TEST(Fill, KeepsWhatIsKnownAndStaysBetweenItsValues) {
    for (unsigned seed = 0; seed < 30; ++seed) {
        AlignedGrid surface;
        surface.first_row = static_cast<std::int32_t>(seed) - 15;
        surface.first_col = 7 - static_cast<std::int32_t>(seed);
        surface.grid = test::random_surface(seed, static_cast<std::int32_t>(2 + seed % 9),
                                            static_cast<std::int32_t>(3 + seed), 2);
        const MetreGrid before = surface.grid;
        fill(surface, 3);
        for (std::size_t k = 0; k < before.size(); ++k) {
            if (before.values[k] != no_value) {
                EXPECT_EQ(surface.grid.values[k], before.values[k]);
            }
            EXPECT_GE(surface.grid.values[k], 0);
            EXPECT_LT(surface.grid.values[k], 50);
        }
    }
}

TEST(Fill, OneKnownCellFillsEverything) {
    AlignedGrid surface;
    surface.grid = MetreGrid(37, 21, no_value);
    surface.grid.at(30, 2) = 12.5F;
    fill(surface, 2);
    for (const float z : surface.grid.values)
        EXPECT_EQ(z, 12.5F);
}

TEST(Fill, AGapInAPlaneIsFilledWithThePlane) {
    AlignedGrid surface = plane(64, 64, 0.25F, -0.125F);
    const MetreGrid whole = surface.grid;
    for (std::int32_t i = 24; i < 40; ++i)
        for (std::int32_t j = 24; j < 40; ++j)
            surface.grid.at(i, j) = no_value;
    fill(surface, 3);
    for (std::size_t k = 0; k < whole.size(); ++k)
        EXPECT_NEAR(surface.grid.values[k], whole.values[k], 0.6) << k;
}

TEST(Fill, FarCellsChangeNothing) {
    AlignedGrid surface;
    surface.grid = test::random_surface(9, 96, 96, 2);
    AlignedGrid part;
    part.first_row = 24;
    part.first_col = 31;
    part.grid = MetreGrid(72, 65);
    for (std::int32_t i = 0; i < 72; ++i)
        for (std::int32_t j = 0; j < 65; ++j)
            part.grid.at(i, j) = surface.grid.at(24 + i, 31 + j);
    fill(surface, 2);
    fill(part, 2);
    for (std::int32_t i = 32; i < 72; ++i)
        for (std::int32_t j = 32; j < 65; ++j)
            ASSERT_EQ(part.grid.at(i, j), surface.grid.at(24 + i, 31 + j));
}

TEST(Fill, WhatAPyramidHeldBeforeDoesNotShow) {
    Pyramid pyramid;
    for (unsigned seed = 0; seed < 9; ++seed) {
        AlignedGrid surface;
        surface.grid = test::random_surface(seed, 40, 33, seed % 3 == 0 ? 1000000 : 1 + seed);
        surface.grid.at(3, 4) = 5;
        AlignedGrid again = surface;
        fill(surface, 3);
        fill_gaps(again, 3, pyramid, test::threads());
        EXPECT_EQ(again.grid.values, surface.grid.values);
    }
}

TEST(InterpolationWeights, FindsTheCentresOfCoarseCells) {
    // Fine cells -1 to 4 in coarse cells of three, -1, 0 and 1; centres of coarse cells: -2, 1, 4.
    const InterpolationWeights places(-1, 6, -1, 3, 3);
    const float expected[] = {1.0F / 3, 2.0F / 3, 0, 1.0F / 3, 2.0F / 3, 0};
    const std::int32_t near[] = {0, 0, 1, 1, 1, 2};
    for (std::int32_t j = 0; j < 6; ++j) {
        EXPECT_EQ(places[j].near, near[j]) << j;
        EXPECT_NEAR(places[j].share, expected[j], 1e-6) << j;
    }
}

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

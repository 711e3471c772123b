#include "ground/fill.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ground/window_pass.hpp"

namespace d2b::ground {
namespace {

/// 1 where a cell has no value; empty where all have one.
std::vector<std::uint8_t> gaps_of(const MetreGrid& grid) {
    std::vector<std::uint8_t> gaps(grid.size());
    std::uint8_t any = 0;
    for (std::size_t k = 0; k < gaps.size(); ++k) {
        gaps[k] = grid.values[k] == no_value ? 1 : 0;
        any = any | gaps[k];
    }
    if (any == 0)
        gaps.clear();
    return gaps;
}

/// The mean of each block's values; `no_value` where it has none.
AlignedGrid means_of_blocks(const AlignedGrid& fine) {
    AlignedGrid coarse = blocks_of(fine, twice, 0.0F);
    std::vector<float> counts(coarse.grid.size(), 0.0F);
    for_each_in_block(fine, coarse, twice, [&](std::size_t cell, std::size_t block) {
        const float value = fine.grid.values[cell];
        const bool known = value != no_value;
        coarse.grid.values[block] += known ? value : 0.0F;
        counts[block] += known ? 1.0F : 0.0F;
    });
    for (std::size_t k = 0; k < counts.size(); ++k)
        coarse.grid.values[k] = counts[k] > 0 ? coarse.grid.values[k] / counts[k] : no_value;
    return coarse;
}

/// Gaps take the value of the level above, between the centres of its cells.
void take_from_above(AlignedGrid& fine, const AlignedGrid& coarse, const std::vector<std::uint8_t>& gap) {
    const Between down(fine.first_row, fine.grid.rows, coarse.first_row, coarse.grid.rows, 2);
    const Between across(fine.first_col, fine.grid.cols, coarse.first_col, coarse.grid.cols, 2);
    for (std::int32_t i = 0; i < fine.grid.rows; ++i) {
        const auto near = coarse.grid.row(down[i].near);
        const auto next = coarse.grid.row(down[i].next);
        for (std::int32_t j = 0; j < fine.grid.cols; ++j) {
            const std::size_t cell = fine.grid.index(i, j);
            if (!gap[cell])
                continue;
            const auto left = static_cast<std::size_t>(across[j].near);
            const auto right = static_cast<std::size_t>(across[j].next);
            const float a = near[left] + down[i].share * (next[left] - near[left]);
            const float b = near[right] + down[i].share * (next[right] - near[right]);
            fine.grid.values[cell] = a + across[j].share * (b - a);
        }
    }
}

/// Gaps take the mean of their four neighbours, all at once: a sweep reaches one cell far.
/// @param above, here room for the old values of two rows
void smooth(MetreGrid& grid, const std::vector<std::uint8_t>& gap, std::vector<float>& above,
            std::vector<float>& here) {
    const auto cols = static_cast<std::size_t>(grid.cols);
    above.assign(grid.row(0).begin(), grid.row(0).end());
    here.resize(cols);
    for (std::int32_t i = 0; i < grid.rows; ++i) {
        float* out = grid.row(i).data();
        const float* below = grid.row(std::min(i + 1, grid.rows - 1)).data();
        const std::uint8_t* open = gap.data() + grid.index(i, 0);
        std::copy_n(out, cols, here.data());
        if (i + 1 == grid.rows)
            below = here.data();
        const auto mean = [&](std::size_t j, std::size_t left, std::size_t right) {
            return 0.25F * ((above[j] + below[j]) + (here[left] + here[right]));
        };
        for (std::size_t j = 1; j + 1 < cols; ++j)
            out[j] = open[j] ? mean(j, j - 1, j + 1) : out[j];
        if (open[0])
            out[0] = mean(0, 0, std::min<std::size_t>(1, cols - 1));
        if (cols > 1 && open[cols - 1])
            out[cols - 1] = mean(cols - 1, cols - 2, cols - 1);
        above.swap(here);
    }
}

}  // namespace

Between::Between(std::int32_t first, std::int32_t cells, std::int32_t coarse_first, std::int32_t coarse_cells,
                 std::int32_t factor) {
    places_.reserve(static_cast<std::size_t>(cells));
    for (std::int32_t j = 0; j < cells; ++j) {
        const std::int32_t block = block_of(first + j, factor);
        const std::int32_t twice_from_centre = 2 * (first + j - block * factor) + 1 - factor;
        const std::int32_t near = block - coarse_first - (twice_from_centre < 0 ? 1 : 0);
        const float from_near =
            static_cast<float>(twice_from_centre + (twice_from_centre < 0 ? 2 * factor : 0)) /
            static_cast<float>(2 * factor);
        places_.push_back({std::max(near, 0), std::min(near + 1, coarse_cells - 1), from_near});
    }
}

void fill_gaps(AlignedGrid& surface, int sweeps) {
    std::vector<AlignedGrid> coarser;
    const auto level = [&](std::size_t k) -> AlignedGrid& { return k == 0 ? surface : coarser[k - 1]; };
    std::vector<std::vector<std::uint8_t>> gaps{gaps_of(surface.grid)};
    while (!gaps.back().empty() && level(coarser.size()).grid.size() > 1) {
        coarser.push_back(means_of_blocks(level(coarser.size())));
        gaps.push_back(gaps_of(coarser.back().grid));
    }
    std::vector<float> above;
    std::vector<float> here;
    for (std::size_t k = coarser.size(); k-- > 0;) {
        take_from_above(level(k), level(k + 1), gaps[k]);
        for (int sweep = 0; sweep < sweeps; ++sweep)
            smooth(level(k).grid, gaps[k], above, here);
    }
}

}  // namespace d2b::ground

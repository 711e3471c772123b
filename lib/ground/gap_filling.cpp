#include "ground/gap_filling.hpp"

#include <algorithm>
#include <bit>

#include "core/grid.hpp"
#include "raster/rank_filter.hpp"

namespace d2b::ground {

/// Returns a if `first` is 1, b if it is 0. Branch-free, because the compiler turns ?: into a branch here.
[[nodiscard]] inline float select(std::uint8_t first, float a, float b) {
    const std::uint32_t mask = 0U - first;
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) |
                                (std::bit_cast<std::uint32_t>(b) & ~mask));
}

namespace {

using Gaps = Grid<std::uint8_t>;

void mark_gaps(std::span<const float> cells, std::span<std::uint8_t> gaps) {
    for (std::size_t j = 0; j < cells.size(); ++j)
        gaps[j] = cells[j] == no_value ? 1 : 0;
}

/// Adds a row of cells to the sums and counts of its blocks of two.
/// @param odd true if the first cell is the second of its block
void add_row(std::span<const float> cells, bool odd, std::span<float> sums, std::span<float> counts) {
    const auto add = [&](std::size_t cell, std::size_t block) {
        const bool known = cells[cell] != no_value;
        sums[block] += known ? cells[cell] : 0.0F;
        counts[block] += known ? 1.0F : 0.0F;
    };
    const std::size_t first = odd ? 1 : 0;
    if (odd)
        add(0, 0);
    const std::size_t pairs = (cells.size() - first) / 2;
    for (std::size_t k = 0; k < pairs; ++k) {
        add(first + 2 * k, first + k);
        add(first + 2 * k + 1, first + k);
    }
    if (first + 2 * pairs < cells.size())
        add(first + 2 * pairs, first + pairs);
}

/// Computes the mean of each block, `no_value` if it has no values, and marks the gaps of the cells.
/// @param means of blocks_of(fine), any values
void compute_means(const AlignedGrid& fine, AlignedGrid& means, Gaps& gaps, Executor& threads) {
    const bool odd = block_of(fine.first_col, 2) * 2 != fine.first_col;
    for_row_bands(threads, means.grid.rows, fine.grid.cols, [&](RowBand band) {
        std::vector<float> counts(static_cast<std::size_t>(means.grid.cols));
        for (std::int32_t row = band.begin; row < band.end; ++row) {
            const std::int32_t first = 2 * (means.first_row + row) - fine.first_row;
            const auto sums = means.grid.row(row);
            std::fill(sums.begin(), sums.end(), 0.0F);
            std::fill(counts.begin(), counts.end(), 0.0F);
            for (std::int32_t i = std::max(first, 0); i < std::min(first + 2, fine.grid.rows); ++i) {
                add_row(fine.grid.row(i), odd, sums, counts);
                mark_gaps(fine.grid.row(i), gaps.row(i));
            }
            for (std::size_t k = 0; k < counts.size(); ++k)
                sums[k] = counts[k] > 0 ? sums[k] / counts[k] : no_value;
        }
    });
}

bool any_gap(const MetreGrid& grid) {
    return std::find(grid.values.begin(), grid.values.end(), no_value) != grid.values.end();
}

/// Adds the next level of the pyramid if it does not exist yet.
void add_level(const AlignedGrid& fine, std::size_t level, Pyramid& pyramid, Executor& threads) {
    if (level < pyramid.coarser.size())
        return;
    pyramid.gaps.push_back(Gaps::unset(fine.grid.rows, fine.grid.cols, threads));
    pyramid.coarser.push_back(blocks_of(fine, twice, 0.0F, threads));
}

/// Values of two rows before smoothing.
struct TwoRows {
    std::vector<float> above;
    std::vector<float> here;
};

/// Sets gaps to the mean of their four neighbours, all at once (Jacobi): each relaxation propagates by one
/// cell.
/// @param gaps_first row of `gaps` that corresponds to the first row of the grid
D2B_MULTIVERSION void smooth(MetreGrid& grid, const Gaps& gaps, std::int32_t gaps_first, TwoRows& old) {
    const auto cols = static_cast<std::size_t>(grid.cols);
    old.above.assign(grid.row(0).begin(), grid.row(0).end());
    old.here.resize(cols);
    for (std::int32_t i = 0; i < grid.rows; ++i) {
        float* out = grid.row(i).data();
        const float* below = grid.row(std::min(i + 1, grid.rows - 1)).data();
        const std::uint8_t* open = gaps.row(gaps_first + i).data();
        const float* above = old.above.data();
        float* here = old.here.data();
        std::copy_n(out, cols, here);
        if (i + 1 == grid.rows)
            below = here;
        const auto mean = [&](std::size_t j, std::size_t left, std::size_t right) {
            return 0.25F * ((above[j] + below[j]) + (here[left] + here[right]));
        };
        for (std::size_t j = 1; j + 1 < cols; ++j) {
            out[j] = select(open[j], mean(j, j - 1, j + 1), here[j]);
        }
        if (open[0])
            out[0] = mean(0, 0, std::min<std::size_t>(1, cols - 1));
        if (cols > 1 && open[cols - 1])
            out[cols - 1] = mean(cols - 1, cols - 2, cols - 1);
        old.above.swap(old.here);
    }
}

/// Fills the gaps of a level from the next coarser one.
void fill_level(AlignedGrid& fine, const Gaps& gaps, const AlignedGrid& coarse, int relaxations,
                Executor& threads) {
    const CoarserLevel above(fine, coarse);
    for_bands_with_halo(threads, fine.grid, relaxations, [&](HaloBand<float>& band) {
        CoarserLevel::Buffers buffers;
        for (std::int32_t i = 0; i < band.rows.rows; ++i)
            above.fill_row(band.first + i, gaps.row(band.first + i), buffers, band.rows.row(i));
        TwoRows rows;
        for (int k = 0; k < relaxations; ++k)
            smooth(band.rows, gaps, band.first, rows);
        band.write_band(fine.grid);
    });
}

/// Interpolates between the centres of blocks of two cells: for each pair of blocks, the cells at one and
/// three quarters of the distance.
D2B_MULTIVERSION void interpolate_between_centres(std::span<const float> blocks, float* cells) {
    for (std::size_t k = 0; k + 1 < blocks.size(); ++k) {
        const float near = blocks[k];
        const float step = blocks[k + 1] - near;
        cells[2 * k] = near + 0.25F * step;
        cells[2 * k + 1] = near + 0.75F * step;
    }
}

D2B_MULTIVERSION void fill_gaps_from(std::span<const std::uint8_t> gap, std::span<const float> by,
                                     std::span<float> cells) {
    for (std::size_t j = 0; j < cells.size(); ++j)
        cells[j] = select(gap[j], by[j], cells[j]);
}

}  // namespace

InterpolationWeights::InterpolationWeights(std::int32_t first, std::int32_t cells, std::int32_t coarse_first,
                                           std::int32_t coarse_cells, std::int32_t factor) {
    weights_.reserve(static_cast<std::size_t>(cells));
    for (std::int32_t j = 0; j < cells; ++j) {
        const std::int32_t block = block_of(first + j, factor);
        const std::int32_t twice_from_centre = 2 * (first + j - block * factor) + 1 - factor;
        const std::int32_t near = block - coarse_first - (twice_from_centre < 0 ? 1 : 0);
        const float from_near =
            static_cast<float>(twice_from_centre + (twice_from_centre < 0 ? 2 * factor : 0)) /
            static_cast<float>(2 * factor);
        weights_.push_back({std::max(near, 0), std::min(near + 1, coarse_cells - 1), from_near});
    }
}

void fill_gaps(AlignedGrid& surface, int relaxations, Pyramid& pyramid, Executor& threads) {
    const auto level = [&](std::size_t k) -> AlignedGrid& {
        return k == 0 ? surface : pyramid.coarser[k - 1];
    };
    std::size_t levels = 0;
    for (; level(levels).grid.size() > 1 && any_gap(level(levels).grid); ++levels) {
        add_level(level(levels), levels, pyramid, threads);
        compute_means(level(levels), pyramid.coarser[levels], pyramid.gaps[levels], threads);
    }
    for (std::size_t k = levels; k-- > 0;)
        fill_level(level(k), pyramid.gaps[k], level(k + 1), relaxations, threads);
}

CoarserLevel::CoarserLevel(const AlignedGrid& fine, const AlignedGrid& coarse)
    : coarse_(coarse.grid),
      down_(fine.first_row, fine.grid.rows, coarse.first_row, coarse.grid.rows, 2),
      across_(fine.first_col, fine.grid.cols, coarse.first_col, coarse.grid.cols, 2),
      first_second_(static_cast<std::size_t>(2 * coarse.first_col + 1 - fine.first_col)) {}

void CoarserLevel::fill_row(std::int32_t row, std::span<const std::uint8_t> gap, Buffers& buffers,
                            std::span<float> cells) const {
    const auto near = coarse_.row(down_[row].near);
    const auto next = coarse_.row(down_[row].next);
    const float share = down_[row].share;
    buffers.blocks.resize(near.size());
    for (std::size_t k = 0; k < near.size(); ++k)
        buffers.blocks[k] = near[k] + share * (next[k] - near[k]);
    buffers.cells.resize(cells.size());
    interpolate_row(buffers);
    fill_gaps_from(gap, buffers.cells, cells);
}

/// Interpolates for all cells, including those with a value, because most are near a gap and the loop then
/// needs no branch.
void CoarserLevel::interpolate_row(Buffers& buffers) const {
    const std::size_t pairs = std::min(buffers.blocks.size() - 1, (buffers.cells.size() - first_second_) / 2);
    interpolate_between_centres(std::span(buffers.blocks).first(pairs + 1),
                                buffers.cells.data() + first_second_);
    const auto place_cell = [&](std::size_t j) {
        const InterpolationWeights::Weights& place = across_[static_cast<std::int32_t>(j)];
        const float a = buffers.blocks[static_cast<std::size_t>(place.near)];
        const float b = buffers.blocks[static_cast<std::size_t>(place.next)];
        buffers.cells[j] = a + place.share * (b - a);
    };
    // Cells before the centre of the first block and after that of the last.
    for (std::size_t j = 0; j < first_second_; ++j)
        place_cell(j);
    for (std::size_t j = first_second_ + 2 * pairs; j < buffers.cells.size(); ++j)
        place_cell(j);
}

}  // namespace d2b::ground

#include "ground/working_surface.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "core/row_bands.hpp"
#include "ground/line_pass.hpp"

namespace d2b::ground {
namespace {

bool is_cell(Factor factor) {
    return factor.down == 1 && factor.across == 1;
}

/// Replaces cells for which `is` holds. Chunks without such cells are only read, because writing them would
/// dirty memory needlessly.
template <typename Is>
void put_where(Executor& threads, MetreGrid& grid, const Is& is, float value) {
    constexpr std::size_t piece = 1024;
    for_cells(threads, grid, [&](std::size_t begin, std::size_t end) {
        for (std::size_t first = begin; first < end; first += piece) {
            const std::span cells(grid.values.data() + first, std::min(piece, end - first));
            int any = 0;
            for (const float z : cells)
                any |= is(z) ? 1 : 0;
            if (any != 0)
                std::ranges::replace_if(cells, is, value);
        }
    });
}

}  // namespace

WorkingSurface::WorkingSurface(MetreGrid& surface, const AlignedGrid& shape, const GridPlace& place,
                               Factor factor, Executor& threads)
    : surface_(surface), place_(place), factor_(factor), threads_(threads) {
    if (!is_cell(factor)) {
        lowest_ = lowest_of_blocks(shape, surface, factor, threads);
        return;
    }
    lowest_ = shape;
    lowest_.grid = std::move(surface);
    const auto has_none = [](float z) { return !(z < no_value); };  // also true for NaN
    put_where(threads, lowest_.grid, has_none, no_value);
}

void WorkingSurface::take_out(const std::vector<Pit>& pits) {
    taken_out_.reserve(pits.size());
    for (const Pit& pit : pits)
        taken_out_.push_back(std::exchange(lowest_.grid.at(pit.row, pit.col), lowest_above(pit)));
}

void WorkingSurface::give_back(const std::vector<Pit>& pits) {
    if (!is_cell(factor_))
        return;
    for (std::size_t i = 0; i < taken_out_.size(); ++i)
        lowest_.grid.at(pits[i].row, pits[i].col) = taken_out_[i];
    surface_ = std::move(lowest_.grid);
    const auto has_none = [](float z) { return z == no_value; };
    put_where(threads_, surface_, has_none, std::numeric_limits<float>::quiet_NaN());
}

/// Returns the lowest point of a cell that is not an outlier, or `no_value`.
float WorkingSurface::lowest_above(const Pit& pit) const {
    if (is_cell(factor_))
        return no_value;
    const std::int32_t row = factor_.down * (lowest_.first_row + pit.row) - place_.row;
    const std::int32_t col = factor_.across * (lowest_.first_col + pit.col) - place_.col;
    float lowest = no_value;
    for (std::int32_t i = std::max(row, 0); i < std::min(row + factor_.down, surface_.rows); ++i)
        for (std::int32_t j = std::max(col, 0); j < std::min(col + factor_.across, surface_.cols); ++j)
            if (const float z = surface_.at(i, j); z >= pit.limit && z < lowest)
                lowest = z;
    return lowest;
}

}  // namespace d2b::ground

#include "ground/outliers.hpp"

#include <algorithm>
#include <cmath>

#include "ground/opening.hpp"
#include "ground/window_pass.hpp"

namespace d2b::ground {
namespace {

Radius at_least_a_cell(double metres, const CellSize& cell) {
    return {std::max(1, static_cast<std::int32_t>(std::lround(metres / cell.down))),
            std::max(1, static_cast<std::int32_t>(std::lround(metres / cell.across)))};
}

}  // namespace

MetreGrid outlier_limits(const AlignedGrid& lowest, const Rules& rules) {
    const MetreGrid& grid = lowest.grid;
    const Radius reach = at_least_a_cell(rules.pit_reach, lowest.cell);
    const MetreGrid closed = closed_by_rectangle(grid, at_least_a_cell(rules.pit_radius, lowest.cell));
    MetreGrid along(grid.rows, grid.cols);
    MetreGrid around(grid.rows, grid.cols);
    window_pass(closed, along, Line::row, Extremum::lowest, reach.across);
    window_pass(along, around, Line::column, Extremum::lowest, reach.down);
    const auto depth = static_cast<float>(rules.pit_depth);
    for (std::size_t k = 0; k < grid.size(); ++k) {
        const float limit = around.values[k] - depth;
        around.values[k] = around.values[k] != no_value && grid.values[k] < limit ? limit : -no_value;
    }
    return around;
}

}  // namespace d2b::ground

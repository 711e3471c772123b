#include "ground/refine.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ground/fill.hpp"
#include "ground/provisional.hpp"

namespace d2b::ground {
namespace {

/// A row between two rows of the working grid.
void row_between(const MetreGrid& grid, const Between::Place& place, std::vector<float>& into) {
    const auto near = grid.row(place.near);
    const auto next = grid.row(place.next);
    for (std::size_t j = 0; j < into.size(); ++j)
        into[j] = near[j] + place.share * (next[j] - near[j]);
}

float at(const std::vector<float>& row, const Between::Place& place) {
    const float near = row[static_cast<std::size_t>(place.near)];
    return near + place.share * (row[static_cast<std::size_t>(place.next)] - near);
}

}  // namespace

Terrain refine(const MetreGrid& surface, const GridPlace& place, const AlignedGrid& working,
               const MetreGrid& outliers, Factor factor, const Rules& rules) {
    const bool none = outliers.size() == 0;
    MetreGrid reach = slopes(working);
    for (float& value : reach.values)
        value = static_cast<float>(rules.tolerance) + static_cast<float>(rules.tolerance_slope) * value;
    const Between down(place.row, surface.rows, working.first_row, working.grid.rows, factor.down);
    const Between across(place.col, surface.cols, working.first_col, working.grid.cols, factor.across);
    Terrain terrain{MetreGrid(surface.rows, surface.cols), Grid<std::uint8_t>(surface.rows, surface.cols)};
    std::vector<float> ground(static_cast<std::size_t>(working.grid.cols));
    std::vector<float> near = ground;
    for (std::int32_t i = 0; i < surface.rows; ++i) {
        row_between(working.grid, down[i], ground);
        row_between(reach, down[i], near);
        const float* limits =
            none ? nullptr : outliers.row(block_of(place.row + i, factor.down) - working.first_row).data();
        const auto from = surface.row(i);
        auto to = terrain.elevation.row(i);
        auto flags = terrain.flags.row(i);
        std::int32_t block = block_of(place.col, factor.across) - working.first_col;
        std::int32_t left = factor.across * (working.first_col + block + 1) - place.col;
        for (std::int32_t j = 0; j < surface.cols; ++j) {
            if (left == 0) {
                ++block;
                left = factor.across;
            }
            --left;
            const auto k = static_cast<std::size_t>(j);
            const float below = at(ground, across[j]);
            const float z = from[k];
            const bool pit = !none && z < limits[block];
            const bool bare = !pit && z - below <= at(near, across[j]);
            to[k] = bare ? z : below;
            flags[k] = static_cast<std::uint8_t>((pit ? low_outlier : 0) | (bare ? bare_ground : 0));
        }
    }
    return terrain;
}

}  // namespace d2b::ground

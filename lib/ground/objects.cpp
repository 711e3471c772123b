#include "ground/objects.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "ground/window_pass.hpp"

namespace d2b::ground {
namespace {

constexpr double widest_in_cells = 30;
constexpr double neighbour_slope = 0.5;

Radius in_cells(double metres, const CellSize& cell) {
    return {static_cast<std::int32_t>(std::lround(metres / cell.down)),
            static_cast<std::int32_t>(std::lround(metres / cell.across))};
}

double smaller_side(const CellSize& cell) {
    return std::min(cell.across, cell.down);
}

/// Lowers the limits of the cells that one opening cut off by more than the windows allow.
void set_limits(const MetreGrid& before, const MetreGrid& after, float rise, MetreGrid& limits) {
    const float* old = before.values.data();
    const float* now = after.values.data();
    float* out = limits.values.data();
    for (std::size_t k = 0; k < after.size(); ++k) {
        const float limit = now[k] + rise;
        out[k] = old[k] > limit && limit < out[k] ? limit : out[k];
    }
}

void lower_limits(MetreGrid& limits, const AlignedGrid& fine, const AlignedGrid& coarse,
                  const MetreGrid& coarse_limits) {
    const MetreGrid around = with_neighbours_limits(coarse_limits, coarse.cell);
    for_each_in_block(fine, coarse, twice, [&](std::size_t cell, std::size_t block) {
        limits.values[cell] = std::min(limits.values[cell], around.values[block]);
    });
}

}  // namespace

MetreGrid with_neighbours_limits(const MetreGrid& limits, const CellSize& cell) {
    MetreGrid around = lowest_around(limits);
    const auto rise = static_cast<float>(neighbour_slope * smaller_side(cell));
    for (std::size_t k = 0; k < around.size(); ++k)
        around.values[k] = std::min(limits.values[k], around.values[k] + rise);
    return around;
}

Opened open_on_cells(const AlignedGrid& surface, const Windows& windows, Opening open) {
    Opened opened{surface, MetreGrid(surface.grid.rows, surface.grid.cols, no_value), windows.radius};
    const CellSize& cell = surface.cell;
    const Radius border = in_cells(windows.border_reach, cell);
    double& radius = opened.next_radius;
    Workspace workspace;
    const std::vector<float>& values = surface.grid.values;
    workspace.gaps = std::find(values.begin(), values.end(), no_value) != values.end();
    MetreGrid next;
    while (radius <= windows.last_radius * 1.0001) {
        Radius cells = in_cells(radius, cell);
        cells = {std::max(cells.down, 1), std::max(cells.across, 1)};
        open(opened.surface.grid, cells, {cells.down - border.down, cells.across - border.across}, workspace,
             next);
        set_limits(opened.surface.grid, next, static_cast<float>(windows.rise + windows.slope * radius),
                   opened.limits);
        std::swap(opened.surface.grid, next);
        radius = std::max(radius + smaller_side(cell), radius * windows.growth);
    }
    return opened;
}

MetreGrid limits_on_blocks(const AlignedGrid& surface, const Windows& windows, Opening open) {
    std::vector<Opened> levels;
    Windows here = windows;
    AlignedGrid blocks;
    do {
        if (!levels.empty())
            blocks = lowest_of_blocks(levels.back().surface, twice);
        const AlignedGrid& cells = levels.empty() ? surface : blocks;
        here.last_radius = std::min(windows.last_radius, widest_in_cells * smaller_side(cells.cell));
        levels.push_back(open_on_cells(cells, here, open));
        here.radius = levels.back().next_radius;
    } while (here.radius <= windows.last_radius * 1.0001);
    for (std::size_t k = levels.size(); k-- > 1;)
        lower_limits(levels[k - 1].limits, levels[k - 1].surface, levels[k].surface, levels[k].limits);
    return std::move(levels.front().limits);
}

}  // namespace d2b::ground

#include "ground/provisional.hpp"

#include <algorithm>
#include <cmath>

#include "ground/connect.hpp"
#include "ground/fill.hpp"
#include "ground/objects.hpp"
#include "ground/walled.hpp"
#include "ground/window_pass.hpp"

namespace d2b::ground {
namespace {

/// The heights up to which cells are ground, by the block that they lie in: below the limit of large objects,
/// or connected to the ground and low enough seen along lines.
struct BlockLimits {
    AlignedGrid blocks;
    MetreGrid sure;
    MetreGrid connected;
};

/// Blocks without a point take the lowest value beside them, so that ground and lines go on between sparse
/// points.
void close_gaps(MetreGrid& grid) {
    const MetreGrid around = lowest_around(grid);
    for (std::size_t k = 0; k < grid.size(); ++k)
        grid.values[k] = grid.values[k] == no_value ? around.values[k] : grid.values[k];
}

BlockLimits limits_of_blocks(const Opened& small, Factor factor, double width, const Rules& rules) {
    BlockLimits found{lowest_of_blocks(small.surface, factor), {}, {}};
    close_gaps(found.blocks.grid);
    Windows windows{small.next_radius, rules.reach * width, rules.large_rise,
                    rules.large_slope, rules.large_growth,  rules.border_reach};
    found.sure = limits_on_blocks(found.blocks, windows, opened_by_rectangle);
    Grid<std::uint8_t> ground =
        connected_ground(found.blocks, found.sure, rules.link_slope, rules.link_steps);
    take_walled_back(found.blocks, found.sure, rules, rules.wall_length * width, ground);
    windows.rise = rules.line_rise;
    windows.slope = rules.line_slope;
    found.connected =
        with_neighbours_limits(limits_on_blocks(found.blocks, windows, opened_by_lines), found.blocks.cell);
    found.sure = with_neighbours_limits(found.sure, found.blocks.cell);
    const auto rise = static_cast<float>(rules.link_rise);
    for (std::size_t k = 0; k < ground.size(); ++k)
        found.connected.values[k] =
            ground.values[k] ? std::min(found.connected.values[k], found.blocks.grid.values[k] + rise)
                             : -no_value;
    return found;
}

void test_again(const AlignedGrid& surface, AlignedGrid& terrain, const Rules& rules) {
    const MetreGrid slope = slopes(terrain);
    const auto near = static_cast<float>(rules.tolerance);
    const auto nearer = static_cast<float>(rules.tolerance_slope);
    for (std::size_t k = 0; k < slope.size(); ++k) {
        const float above = surface.grid.values[k] - terrain.grid.values[k];
        const bool is_ground = above <= near + nearer * slope.values[k];
        terrain.grid.values[k] = is_ground ? surface.grid.values[k] : no_value;
    }
}

}  // namespace

AlignedGrid without_objects(const AlignedGrid& surface, double width, const Rules& rules) {
    const double cell = std::min(surface.cell.across, surface.cell.down);
    const Windows windows{
        cell, rules.small_radius, 0, rules.small_slope, rules.small_growth, rules.border_reach};
    const Opened small = open_on_cells(surface, windows, opened_by_rectangle);
    const Factor factor = factor_for(surface.cell, rules.block);
    const BlockLimits large = limits_of_blocks(small, factor, width, rules);
    AlignedGrid ground = surface;
    for_each_in_block(surface, large.blocks, factor, [&](std::size_t k, std::size_t block) {
        const float opened = small.surface.grid.values[k];
        const bool is_ground =
            surface.grid.values[k] <= small.limits.values[k] &&
            (opened <= large.sure.values[block] || opened <= large.connected.values[block]);
        ground.grid.values[k] = is_ground ? surface.grid.values[k] : no_value;
    });
    return ground;
}

AlignedGrid working_terrain(const AlignedGrid& surface, double width, const Rules& rules) {
    AlignedGrid terrain = without_objects(surface, width, rules);
    fill_gaps(terrain, rules.sweeps);
    for (int round = 0; round < rules.rounds; ++round) {
        test_again(surface, terrain, rules);
        fill_gaps(terrain, rules.sweeps);
    }
    return terrain;
}

MetreGrid slopes(const AlignedGrid& terrain) {
    const MetreGrid& z = terrain.grid;
    MetreGrid slope(z.rows, z.cols);
    for (std::int32_t i = 0; i < z.rows; ++i) {
        const std::int32_t above = std::max(i - 1, 0);
        const std::int32_t below = std::min(i + 1, z.rows - 1);
        const float down =
            below > above ? 1.0F / static_cast<float>((below - above) * terrain.cell.down) : 0.0F;
        const auto north = z.row(above);
        const auto south = z.row(below);
        const auto here = z.row(i);
        auto out = slope.row(i);
        for (std::size_t j = 0; j < here.size(); ++j) {
            const std::size_t left = j > 0 ? j - 1 : 0;
            const std::size_t right = std::min(j + 1, here.size() - 1);
            const float across =
                right > left
                    ? 1.0F / static_cast<float>(static_cast<double>(right - left) * terrain.cell.across)
                    : 0.0F;
            const float y = (south[j] - north[j]) * down;
            const float x = (here[right] - here[left]) * across;
            out[j] = std::sqrt(x * x + y * y);
        }
    }
    return slope;
}

}  // namespace d2b::ground

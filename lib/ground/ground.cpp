#include "ground/ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ground/estimate.hpp"
#include "ground/outliers.hpp"
#include "ground/provisional.hpp"
#include "ground/refine.hpp"
#include "ground/window_pass.hpp"

namespace d2b {
namespace ground {
namespace {

/// The lowest valid point of each block that is above the block's limit, if there is one.
AlignedGrid lowest_points(const MetreGrid& surface, const CellSize& cell, const GridPlace& place,
                          Factor factor, const MetreGrid* above) {
    AlignedGrid shape;
    shape.first_row = place.row;
    shape.first_col = place.col;
    shape.cell = cell;
    shape.grid.rows = surface.rows;
    shape.grid.cols = surface.cols;
    AlignedGrid blocks = blocks_of(shape, factor, no_value);
    float* lowest = blocks.grid.values.data();
    for_each_in_block(shape, blocks, factor, [&](std::size_t k, std::size_t block) {
        const float z = surface.values[k];
        if (z < lowest[block] && (above == nullptr || z >= above->values[block]))
            lowest[block] = z;
    });
    return blocks;
}

/// Windows of a chain of openings: each reaches twice its radius, rounded to cells that grow up to its size.
double chain_support(double radius, double last_radius, double growth, double cell) {
    double sum = 0;
    while (radius <= last_radius * 1.0001) {
        sum += 2 * radius + 2 * cell;
        radius = std::max(radius + cell, radius * growth);
    }
    return sum;
}

/// Gaps as wide as twice the distance to the ground are filled from blocks of that size, and those from
/// blocks around them that each level's interpolation and smoothing reach.
double fill_support(double distance, double cell, int sweeps) {
    double sum = 0;
    double block = cell;
    while (block < 4 * distance) {
        sum += (3 + sweeps) * block;
        block *= 2;
    }
    return sum;
}

}  // namespace

Terrain estimate(const MetreGrid& surface, const CellSize& cell, double width, const Context& context,
                 const GridPlace& place, const Rules& rules) {
    if (surface.size() == 0)
        return {};
    const Factor factor = factor_for(cell, rules.work_cell);
    AlignedGrid lowest = lowest_points(surface, cell, place, factor, nullptr);
    const auto known = [](float value) { return value != no_value; };
    if (std::none_of(lowest.grid.values.begin(), lowest.grid.values.end(), known))
        return {MetreGrid(surface.rows, surface.cols, std::numeric_limits<float>::quiet_NaN()),
                Grid<std::uint8_t>(surface.rows, surface.cols)};
    context.progress(0.1);
    MetreGrid pits = outlier_limits(lowest, rules);
    const auto pit = [](float limit) { return limit != -no_value; };
    if (std::any_of(pits.values.begin(), pits.values.end(), pit))
        lowest = lowest_points(surface, cell, place, factor, &pits);
    else
        pits = {};
    const AlignedGrid terrain = working_terrain(lowest, width, rules);
    context.progress(0.9);
    return refine(surface, place, terrain, pits, factor, rules);
}

double support(const CellSize& cell, double width, const Rules& rules) {
    const double side = std::max(cell.across, cell.down);
    const Factor small = factor_for(cell, rules.work_cell);
    const double work = std::max(cell.across * small.across, cell.down * small.down);
    const double block = std::max(work, 2 * rules.block);
    const double widest = rules.reach * width;
    const double pits = 2 * (rules.pit_radius + work) + rules.pit_reach + work;
    // Limits of blocks hold for their neighbours: blocks of the coarsest level are as large as a window's
    // part.
    const double neighbours = 2 * std::max(widest / 4, block);
    return side + pits + chain_support(work, rules.small_radius, rules.small_growth, work) +
           chain_support(rules.small_radius, widest, rules.large_growth, block) + neighbours +
           rules.link_steps * block + rules.wall_length * width + 2 * block +
           (1 + rules.rounds) * (fill_support(width, work, rules.sweeps) + 2 * work);
}

}  // namespace ground

double ground_support(const CellSize& cell, const GroundOptions& options) {
    return ground::support(cell, options.max_building_width, {});
}

Terrain estimate_ground(const MetreGrid& surface, const CellSize& cell, const GroundOptions& options,
                        Context& context, const GridPlace& place) {
    return ground::estimate(surface, cell, options.max_building_width, context, place, {});
}

}  // namespace d2b

#include "ground/ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "ground/estimate.hpp"
#include "ground/line_pass.hpp"
#include "ground/outliers.hpp"
#include "ground/provisional.hpp"
#include "ground/refine.hpp"
#include "ground/working_surface.hpp"

namespace d2b {
namespace ground {
namespace {

AlignedGrid shape_at(const MetreGrid& surface, const CellSize& cell, const GridPlace& place) {
    AlignedGrid shape;
    shape.first_row = place.row;
    shape.first_col = place.col;
    shape.cell = cell;
    shape.grid.rows = surface.rows;
    shape.grid.cols = surface.cols;
    return shape;
}

/// Reach of a series of openings: each depends on cells within twice its radius, rounded up to cells that
/// grow to its size.
double openings_halo(double radius, double last_radius, double growth, double cell) {
    double sum = 0;
    while (radius <= last_radius * 1.0001) {
        sum += 2 * radius + 2 * cell;
        radius = std::max(radius + cell, radius * growth);
    }
    return sum;
}

/// Reach of filling: gaps as wide as twice the distance to the ground are filled from blocks of that size,
/// which depend on the blocks within reach of each level's interpolation and smoothing.
double fill_halo(double distance, double cell, int relaxations) {
    double sum = 0;
    double block = cell;
    while (block < 4 * distance) {
        sum += (3 + relaxations) * block;
        block *= 2;
    }
    return sum;
}

}  // namespace

Terrain estimate(MetreGrid& surface, const CellSize& cell, double width, const Context& context,
                 const GridPlace& place, const Rules& rules) {
    if (surface.size() == 0)
        return {};
    Executor& threads = *context.threads;
    const Factor factor = factor_for(cell, rules.work_cell);
    WorkingSurface working(surface, shape_at(surface, cell, place), place, factor, threads);
    const auto known = [](float value) { return value != no_value; };
    if (std::ranges::none_of(working.lowest().grid.values, known)) {
        working.give_back({});
        return {MetreGrid(surface.rows, surface.cols, std::numeric_limits<float>::quiet_NaN()),
                Grid<std::uint8_t>(surface.rows, surface.cols)};
    }
    context.progress(0.1);
    const std::vector<Pit> pits = find_pits(working.lowest(), rules, threads);
    working.take_out(pits);
    AlignedGrid terrain = working_terrain(working.lowest(), width, rules, threads);
    working.give_back(pits);
    context.progress(0.9);
    return refine(surface, place, std::move(terrain), pits, factor, rules, threads);
}

double halo(const CellSize& cell, double width, const Rules& rules) {
    const double side = std::max(cell.across, cell.down);
    const Factor small = factor_for(cell, rules.work_cell);
    const double work = std::max(cell.across * small.across, cell.down * small.down);
    const double block = std::max(work, 2 * rules.block);
    const double widest = rules.reach * width;
    const double pits = 2 * (rules.pit_radius + work) + rules.pit_reach + work;
    // Limits of blocks also apply to their neighbours, and blocks of the coarsest level are as large as part
    // of an element.
    const double neighbours = 2 * std::max(widest / 4, block);
    return side + pits + openings_halo(work, rules.small_radius, rules.small_growth, work) +
           openings_halo(rules.small_radius, widest, rules.large_growth, block) + neighbours +
           rules.link_steps * block + rules.wall_length * width + 2 * block +
           (1 + rules.rounds) * (fill_halo(width, work, rules.relaxations) + 2 * work);
}

}  // namespace ground

double ground_halo(const CellSize& cell, const GroundOptions& options) {
    return ground::halo(cell, options.max_building_width, ground::rules_for(cell));
}

Terrain estimate_ground(MetreGrid& surface, const CellSize& cell, const GroundOptions& options,
                        Context& context, const GridPlace& place) {
    return ground::estimate(surface, cell, options.max_building_width, context, place,
                            ground::rules_for(cell));
}

}  // namespace d2b

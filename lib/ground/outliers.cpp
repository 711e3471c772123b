#include "ground/outliers.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "ground/line_pass.hpp"
#include "ground/opening.hpp"
#include "ground/tiles.hpp"
#include "ground/whole_steps.hpp"

namespace d2b::ground {
namespace {

Radius at_least_a_cell(double metres, const CellSize& cell) {
    return {std::max(1, static_cast<std::int32_t>(std::lround(metres / cell.down))),
            std::max(1, static_cast<std::int32_t>(std::lround(metres / cell.across)))};
}

/// Buffers for a tile with its surroundings.
struct Part {
    WholeSteps whole;  ///< replaces the others if all elevations are whole steps
    MetreGrid surface;
    MetreGrid next;
    Workspace<float> workspace;
};

struct Search {
    Radius closed;
    Radius around;
    float depth;

    [[nodiscard]] std::int32_t reach() const {
        return std::max(2 * closed.down + around.down, 2 * closed.across + around.across);
    }
    /// Returns true if a value lies deep below `other`; false if there is no `other`.
    [[nodiscard]] bool below(float z, float other) const { return other != no_value && z < other - depth; }
};

/// Returns true if any cell may lie deep below the closed surface. @param deep tests two values
template <typename T, typename Deep>
bool may_have_pits(const Grid<T>& surface, const Grid<T>& closed, Deep deep) {
    int any = 0;
    for (std::size_t k = 0; k < surface.size(); ++k) {
        const T above = closed.values[k];
        any |= (above != no_value_of<T> ? 1 : 0) & (deep(surface.values[k], above) ? 1 : 0);
    }
    return any != 0;
}

/// Computes the minimum around each cell of the closed surface. @return false if no cell can be a pit, so
/// that it was not computed
template <typename T, typename Deep>
bool find_around(const Grid<T>& surface, const Search& search, Workspace<T>& workspace, Grid<T>& around,
                 Deep deep) {
    closed_by_rectangle(surface, search.closed, workspace, around);
    if (!may_have_pits(surface, around, deep))  // necessary condition
        return false;
    Grid<T>& along_rows = workspace.roomy;
    along_rows = around;
    line_pass(around, along_rows, Line::row, Extremum::lowest, search.around.across);
    line_pass(along_rows, around, Line::column, Extremum::lowest, search.around.down);
    return true;
}

std::vector<Pit> pits_of(const MetreGrid& lowest, const Tile& tile, const Search& search, Part& part) {
    const Tile place = widened(tile, search.reach(), lowest);
    WholeSteps& whole = part.whole;
    const bool in_steps = whole.take(lowest, place);
    bool any = false;
    if (in_steps) {
        const int within = whole.surely_within(search.depth);
        any = find_around(whole.surface, search, whole.workspace, whole.next,
                          [within](std::int16_t z, std::int16_t above) { return above - z > within; });
    } else {
        copy_tile(lowest, place, part.surface);
        any = find_around(part.surface, search, part.workspace, part.next,
                          [&](float z, float above) { return z < above - search.depth; });
    }
    std::vector<Pit> pits;
    std::vector<float> around(static_cast<std::size_t>(tile.cols));
    for (std::int32_t i = tile.row; any && i < tile.row + tile.rows; ++i) {
        const auto first = static_cast<std::size_t>(tile.col - place.col);
        if (in_steps)
            whole.in_metres(whole.next.row(i - place.row).subspan(first, around.size()), around.data());
        else
            std::ranges::copy(part.next.row(i - place.row).subspan(first, around.size()), around.begin());
        for (std::int32_t j = 0; j < tile.cols; ++j) {
            const float beside = around[static_cast<std::size_t>(j)];
            if (search.below(lowest.at(i, tile.col + j), beside))
                pits.push_back({i, tile.col + j, beside - search.depth});
        }
    }
    return pits;
}

}  // namespace

std::vector<Pit> find_pits(const AlignedGrid& lowest, const Rules& rules, Executor& threads) {
    const Search search{at_least_a_cell(rules.pit_radius, lowest.cell),
                        at_least_a_cell(rules.pit_reach, lowest.cell), static_cast<float>(rules.pit_depth)};
    const std::vector<Tile> tiles = tiles_of(lowest.grid.rows, lowest.grid.cols, tile_side);
    std::vector<std::vector<Pit>> found(tiles.size());
    threads.for_each_in_room<Part>(tiles.size(), [&](std::size_t t, Part& part) {
        found[t] = pits_of(lowest.grid, tiles[t], search, part);
    });
    std::vector<Pit> pits;
    for (const std::vector<Pit>& some : found)
        pits.insert(pits.end(), some.begin(), some.end());
    std::sort(pits.begin(), pits.end(),
              [](const Pit& a, const Pit& b) { return std::tie(a.row, a.col) < std::tie(b.row, b.col); });
    return pits;
}

}  // namespace d2b::ground

#include "ground/outliers.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/processors.hpp"
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

/// Room for a tile and what lies around it.
struct Part {
    MetreGrid surface;
    MetreGrid closed;
    MetreGrid around;
    Workspace<float> workspace;
    WholeSteps whole;  ///< its `next` is closed
};

struct Search {
    Radius closed;
    Radius around;
    float depth;

    [[nodiscard]] std::int32_t reach() const {
        return std::max(2 * closed.down + around.down, 2 * closed.across + around.across);
    }
    /// Whether a value lies deep below another; not where there is none.
    [[nodiscard]] bool below(float z, float other) const { return other != no_value && z < other - depth; }
};

/// Whether a cell may lie deep below the closed surface; most tiles have none.
/// @param deep how much lower it is at least
template <typename T, typename Deep>
bool may_have_pits(const Grid<T>& surface, const Grid<T>& closed, Deep deep) {
    int any = 0;
    for (std::size_t k = 0; k < surface.size(); ++k) {
        const T above = closed.values[k];
        any |= (above != no_value_of<T> ? 1 : 0) & (deep(surface.values[k], above) ? 1 : 0);
    }
    return any != 0;
}

/// In whole steps, where these say that there is none.
D2B_FOR_EACH_PROCESSOR bool surely_has_no_pits(const MetreGrid& lowest, const Tile& place,
                                               const Search& search, WholeSteps& whole) {
    if (!whole.take(lowest, place))
        return false;
    closed_by_rectangle(whole.surface, search.closed, whole.workspace, whole.next);
    const int within = whole.surely_within(search.depth);
    return !may_have_pits(whole.surface, whole.next,
                          [within](std::int16_t z, std::int16_t above) { return above - z > within; });
}

std::vector<Pit> pits_of(const MetreGrid& lowest, const Tile& tile, const Search& search, Part& part) {
    const Tile place = widened(tile, search.reach(), lowest);
    if (surely_has_no_pits(lowest, place, search, part.whole))
        return {};
    copy_tile(lowest, place, part.surface);
    closed_by_rectangle(part.surface, search.closed, part.workspace, part.closed);
    // Below all around is below what is here.
    const float depth = search.depth;
    if (!may_have_pits(part.surface, part.closed,
                       [depth](float z, float above) { return z < above - depth; }))
        return {};
    MetreGrid& along = part.workspace.first;
    part.around = part.closed;
    line_pass(part.closed, along, Line::row, Extremum::lowest, search.around.across);
    line_pass(along, part.around, Line::column, Extremum::lowest, search.around.down);
    std::vector<Pit> pits;
    for (std::int32_t i = tile.row; i < tile.row + tile.rows; ++i)
        for (std::int32_t j = tile.col; j < tile.col + tile.cols; ++j) {
            const float around = part.around.at(i - place.row, j - place.col);
            if (search.below(lowest.at(i, j), around))
                pits.push_back({i, j, around - search.depth});
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

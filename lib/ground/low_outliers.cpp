#include "ground/low_outliers.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "ground/aligned_grid.hpp"
#include "ground/opening.hpp"
#include "ground/rank_filter.hpp"

namespace d2b::ground {
namespace {

Radius at_least_one_cell(double metres, const CellSize& cell) {
    return {std::max(1, static_cast<std::int32_t>(std::lround(metres / cell.down))),
            std::max(1, static_cast<std::int32_t>(std::lround(metres / cell.across)))};
}

/// Buffers for a tile with its surroundings.
struct TileBuffers {
    MetreGrid surface;
    MetreGrid around;
    Workspace workspace;
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

/// Returns true if any cell may lie deep below the closed surface, which is a necessary condition.
bool may_have_outliers(const MetreGrid& surface, const MetreGrid& closed, const Search& search) {
    int any = 0;
    for (std::size_t k = 0; k < surface.size(); ++k)
        any |= search.below(surface.values[k], closed.values[k]) ? 1 : 0;
    return any != 0;
}

std::vector<LowOutlier> low_outliers_of(const MetreGrid& lowest, const Tile& tile, const Search& search,
                                        TileBuffers& part) {
    const Tile place = widened(tile, search.reach(), lowest);
    copy_tile(lowest, place, part.surface);
    MetreGrid& around = part.around;
    close_rectangle(part.surface, search.closed, part.workspace, around);
    std::vector<LowOutlier> low_outliers;
    if (!may_have_outliers(part.surface, around, search))
        return low_outliers;
    part.workspace.filter.apply(around, Line::row, Extremum::lowest, search.around.across);
    part.workspace.filter.apply(around, Line::column, Extremum::lowest, search.around.down);
    for (std::int32_t i = tile.row; i < tile.row + tile.rows; ++i)
        for (std::int32_t j = tile.col; j < tile.col + tile.cols; ++j) {
            const float beside = around.at(i - place.row, j - place.col);
            if (search.below(lowest.at(i, j), beside))
                low_outliers.push_back({i, j, beside - search.depth});
        }
    return low_outliers;
}

}  // namespace

std::vector<LowOutlier> find_low_outliers(const AlignedGrid& lowest, const Rules& rules, Executor& threads) {
    const Search search{at_least_one_cell(rules.outlier_radius, lowest.cell),
                        at_least_one_cell(rules.outlier_reach, lowest.cell),
                        static_cast<float>(rules.outlier_depth)};
    const std::vector<Tile> tiles = tiles_of(lowest.grid.rows, lowest.grid.cols, tile_side);
    std::vector<std::vector<LowOutlier>> found(tiles.size());
    threads.for_each_with_scratch<TileBuffers>(tiles.size(), [&](std::size_t t, TileBuffers& part) {
        found[t] = low_outliers_of(lowest.grid, tiles[t], search, part);
    });
    std::vector<LowOutlier> low_outliers;
    for (const std::vector<LowOutlier>& some : found)
        low_outliers.insert(low_outliers.end(), some.begin(), some.end());
    std::sort(low_outliers.begin(), low_outliers.end(), [](const LowOutlier& a, const LowOutlier& b) {
        return std::tie(a.row, a.col) < std::tie(b.row, b.col);
    });
    return low_outliers;
}

}  // namespace d2b::ground

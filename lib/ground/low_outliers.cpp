#include "ground/low_outliers.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "ground/quantized_elevations.hpp"
#include "raster/opening.hpp"
#include "raster/rank_filter.hpp"

namespace d2b::ground {
namespace {

Radius at_least_one_cell(double metres, const CellSize& cell) {
    return {std::max(1, static_cast<std::int32_t>(std::lround(metres / cell.down))),
            std::max(1, static_cast<std::int32_t>(std::lround(metres / cell.across)))};
}

/// Buffers for a tile with its surroundings.
struct TileBuffers {
    QuantizedElevations quantized;  ///< replaces the others if all elevations are whole steps
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
bool may_have_outliers(const Grid<T>& surface, const Grid<T>& closed, Deep deep) {
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
bool find_surrounding_minimum(const Grid<T>& surface, const Search& search, Workspace<T>& workspace,
                              Grid<T>& around, Deep deep) {
    close_rectangle(surface, search.closed, workspace, around);
    if (!may_have_outliers(surface, around, deep))  // necessary condition
        return false;
    Grid<T>& along_rows = workspace.padded;
    along_rows = around;
    rank_filter(around, along_rows, Line::row, Extremum::lowest, search.around.across);
    rank_filter(along_rows, around, Line::column, Extremum::lowest, search.around.down);
    return true;
}

std::vector<LowOutlier> low_outliers_of(const MetreGrid& lowest, const Tile& tile, const Search& search,
                                        TileBuffers& part) {
    const Tile place = widened(tile, search.reach(), lowest);
    QuantizedElevations& quantized = part.quantized;
    const bool is_quantized = quantized.take(lowest, place);
    bool any = false;
    if (is_quantized) {
        const int within = quantized.guaranteed_steps(search.depth);
        any = find_surrounding_minimum(
            quantized.surface, search, quantized.workspace, quantized.next,
            [within](std::int16_t z, std::int16_t above) { return above - z > within; });
    } else {
        copy_tile(lowest, place, part.surface);
        any = find_surrounding_minimum(part.surface, search, part.workspace, part.next,
                                       [&](float z, float above) { return z < above - search.depth; });
    }
    std::vector<LowOutlier> low_outliers;
    std::vector<float> around(static_cast<std::size_t>(tile.cols));
    for (std::int32_t i = tile.row; any && i < tile.row + tile.rows; ++i) {
        const auto first = static_cast<std::size_t>(tile.col - place.col);
        if (is_quantized)
            quantized.to_metres(quantized.next.row(i - place.row).subspan(first, around.size()),
                                around.data());
        else
            std::ranges::copy(part.next.row(i - place.row).subspan(first, around.size()), around.begin());
        for (std::int32_t j = 0; j < tile.cols; ++j) {
            const float beside = around[static_cast<std::size_t>(j)];
            if (search.below(lowest.at(i, tile.col + j), beside))
                low_outliers.push_back({i, tile.col + j, beside - search.depth});
        }
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

#pragma once

#include <functional>
#include <span>
#include <vector>

#include "ground/aligned_grid.hpp"
#include "ground/quantized_elevations.hpp"
#include "raster/opening.hpp"

namespace d2b::ground {

/// Sequence of structuring elements, and the height above their openings that makes an object.
struct OpeningParameters {
    double radius = 1;         ///< radius of the next element, metres
    double last_radius = 1;    ///< radius of the widest element
    double rise = 0;           ///< an object rises above the opened surface by this ...
    double slope = 0;          ///< ... plus this times the radius
    double growth = 1.2;       ///< between elements, but at least one cell
    double border_reach = 14;  ///< reach of elements into the grid at its border, or their radius
    double border_width = 0;   ///< within this distance from the border of the grid ...
    double border_share = 1;   ///< ... an object rises by this share of that
};

/// Structuring element in cells.
struct StructuringElement {
    Radius radius;
    Radius outside;          ///< extent beyond the grid
    float rise = 0;          ///< height of an object above the opened surface
    Radius border = {0, 0};  ///< within this distance from the border of the grid ...
    float border_rise = 0;   ///< ... an object rises by this
};

/// Successive openings of a grid with cells of one size.
struct ElementSeries {
    std::vector<StructuringElement> steps;
    double next_radius = 0;  ///< radius of the next element, metres
};
[[nodiscard]] ElementSeries element_series(const OpeningParameters& elements, const CellSize& cell);

/// Part of a grid after removal of objects up to some width, and the height above which a cell was part of
/// one, `no_value` if it was not. Reused, so that memory is allocated once.
struct OpenedPart {
    Tile tile;   ///< requested part
    Tile place;  ///< part with the surroundings that its elements need
    std::int32_t grid_rows = 0;
    std::int32_t grid_cols = 0;
    MetreGrid limits;           ///< covers `tile`
    bool is_quantized = false;  ///< true if the surface is stored as integers
    QuantizedElevations quantized;
    MetreGrid surface;  ///< covers `place`, but is correct only in `tile`
    MetreGrid next;
    Workspace<float> workspace;

    /// Returns a row of the tile in `surface` or another grid of `place`. @param i from the tile's first row
    template <typename T>
    [[nodiscard]] std::span<const T> row(const Grid<T>& grid, std::int32_t i) const {
        return grid.row(tile.row - place.row + i)
            .subspan(static_cast<std::size_t>(tile.col - place.col), static_cast<std::size_t>(tile.cols));
    }
    /// Writes a row of the opened surface in metres. @param i from the tile's first row @param out as many
    /// cells
    void write_row(std::int32_t i, float* out) const;
};

/// Progressive opening as in SMRF (Pingel, Clarke and McBride, 2013): each element opens the result of the
/// previous one.
void open_part(const MetreGrid& surface, const Tile& tile, std::span<const StructuringElement> steps,
               ElementShape element, OpenedPart& part);

/// Same for all cells, but wider elements are applied to a pyramid of 2 x 2 blocks, so that the cost per cell
/// does not grow with the widest element. @return the limits
/// @param beside independent single-threaded work, done once while the other threads open
[[nodiscard]] MetreGrid limits_on_blocks(const AlignedGrid& surface, const OpeningParameters& elements,
                                         ElementShape element, Executor& threads,
                                         std::function<void()> beside = {});

/// Applies the limit of a block also to its neighbours, plus the height that ground may rise in between,
/// because walls do not follow blocks.
[[nodiscard]] MetreGrid spread_limits(const MetreGrid& limits, const CellSize& cell, Executor& threads);

}  // namespace d2b::ground

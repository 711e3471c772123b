#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/stop_token.hpp"
#include "raster/row_spans.hpp"

namespace d2b::contours {

/// Cells of one building and their elevations.
struct BuildingCells {
    std::vector<RowSpan> runs;          ///< runs in scan order; those of a row do not touch
    std::vector<double> elevations;     ///< by cell of the runs; NaN if not valid
    std::vector<std::size_t> spires{};  ///< ascending indices of cells that stand above their surroundings
};

/// Connected cells of a building that form one tier.
struct TierRegion {
    std::int64_t points = 0;  ///< number of valid points
    double mean = 0;          ///< mean elevation; undefined without points
};

struct TierRegions {
    std::vector<TierRegion> regions;
    std::vector<std::uint32_t> of_cell;  ///< region by cell in scan order
};

struct RegionOptions {
    double price = 0;  ///< price of a border of one cell, in squared elevations of a cell
    int least_width =
        1;  ///< width in cells: a region that contains no square of this width is merged with a neighbour
    double own_border = 0;  ///< border in cells that is charged per region in addition to its actual one
};

/// Segments a building into tiers: regions of constant height that minimise the squared error of their
/// elevations plus a price on the length of their borders (the piecewise constant model of Mumford and Shah
/// 1989), by merging the neighbours whose union costs least per length of border (Koepfler, Lopez and Morel
/// 1994). A strip w cells wide that stands out by d on one side stays if w d^2 exceeds the price. Blurred
/// walls, chimneys and speckle are too narrow, and join the region at the lowest cost. The result only
/// depends on the building's cells.
/// @throws Cancelled
[[nodiscard]] TierRegions merge_regions(const BuildingCells& cells, const RegionOptions& options,
                                        const StopToken& stop = {});

}  // namespace d2b::contours

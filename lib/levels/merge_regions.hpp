#pragma once

#include <cstdint>
#include <vector>

#include "core/stop_request.hpp"
#include "levels/building_cells.hpp"

namespace d2b {

/// Connected cells of a building that are one tier, as far as its elevations go.
struct TierRegion {
    std::int64_t points = 0;  ///< valid ones
    double mean = 0;          ///< of their elevations; of no meaning where there is none
};

struct TierRegions {
    std::vector<TierRegion> regions;
    std::vector<std::uint32_t> of_cell;  ///< by cell in scan order
};

struct RegionOptions {
    double price = 0;     ///< of a border as long as a cell, in squared elevations of a cell
    int least_width = 1;  ///< cells: a region that holds no square of this width belongs to one beside it
    double own_border =
        0;  ///< border, in lengths of a cell, that each region is charged with beside what it has
};

/// A clean image of a building's tiers: regions of constant height that keep the squared error of their
/// elevations plus a price on the length of their borders small (Mumford and Shah 1989, their piecewise
/// constant model), by merging the neighbours whose union costs least a length of border (Koepfler, Lopez
/// and Morel 1994). A strip of w cells' width that stands out by d on one side stays if w d^2 exceeds the
/// price. What a wall smears, chimneys and speckle are too narrow and go to the region that it costs least
/// to join. The result depends on the building's cells alone. @throws Cancelled
[[nodiscard]] TierRegions merge_regions(const BuildingCells& cells, const RegionOptions& options,
                                        const StopRequest& stop = {});

}  // namespace d2b

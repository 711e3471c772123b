#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "dem2buildings/dem_source.hpp"
#include "read/grid_transform.hpp"

namespace d2b {

/// Cells of one grid in another: row and column of a cell there, less those here.
struct CellOffset {
    std::int32_t rows = 0;
    std::int32_t cols = 0;
};

/// Where the cells of two grids coincide to a thousandth of a cell all over the DEM's window: the raster's
/// row and column less the DEM's. Nothing where values have to be resampled.
[[nodiscard]] std::optional<CellOffset> whole_cell_offset(const GridTransform& transform,
                                                          const DemInfo& grid);

/// How much of a window a raster covers.
struct Coverage {
    double share =
        0;  ///< of the window's cells whose centres lie in the raster; of 201 x 201 of them at most
    bool meets =
        false;  ///< whether there is any such cell: small rasters are looked for the other way round, too
};
[[nodiscard]] Coverage coverage(const GridTransform& transform, const DemInfo& raster, const DemInfo& grid);

/// What a cell in the middle of the DEM measures in the raster's columns and rows; 1 and 1 where it has no
/// image there. Of the whole DEM, so that it is the same for every window.
[[nodiscard]] std::array<double, 2> cell_in_raster(const GridTransform& transform, const DemInfo& grid);

}  // namespace d2b

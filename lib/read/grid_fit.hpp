#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "dem2buildings/dem_source.hpp"
#include "read/grid_transform.hpp"

namespace d2b {

/// Offset between two grids in cells: row and column of a cell in the other grid minus those in this one.
struct CellOffset {
    std::int32_t rows = 0;
    std::int32_t cols = 0;
};

/// Returns the row and column of the raster minus those of the DEM if cells of both grids coincide to a
/// thousandth of a cell in the whole window. Returns nothing if values have to be resampled.
[[nodiscard]] std::optional<CellOffset> whole_cell_offset(const GridTransform& transform,
                                                          const DemInfo& grid);

/// Overlap of a raster with a window.
struct Coverage {
    double share = 0;  ///< share of the window's cells whose centres lie in the raster, from a sample of at
                       ///< most 201 x 201
    bool meets =
        false;  ///< true if there is any such cell; cells of small rasters are also tested against the window
};
[[nodiscard]] Coverage coverage(const GridTransform& transform, const DemInfo& raster, const DemInfo& grid);

/// Returns the size of a cell in the middle of the DEM in columns and rows of the raster, or 1 and 1 if it
/// has no image there. Uses the whole DEM, so that the result is the same for every window.
[[nodiscard]] std::array<double, 2> cell_in_raster(const GridTransform& transform, const DemInfo& grid);

}  // namespace d2b

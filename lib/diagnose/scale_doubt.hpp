#pragma once

#include <string>

namespace d2b {

/// Returns a warning if cells are too coarse for single buildings: wider than 3 m. A clause without a full
/// stop; "" if they are not.
/// @param cell_m cell size in m
[[nodiscard]] std::string coarse_cells_doubt(double cell_m);

/// Returns a warning if -simplify would remove most of a building: its tolerance exceeds 100 cells. A clause
/// without a full stop; "" if it does not.
/// @param tolerance, cell tolerance and cell size in units of the DEM's CRS
[[nodiscard]] std::string tolerance_doubt(double tolerance, double cell);

}  // namespace d2b

#pragma once

#include <string>

namespace d2b {

/// That cells are too coarse for single buildings: wider than 3 m. Without a full stop; "" where they are
/// not.
/// @param cell_m side of a cell in metres
[[nodiscard]] std::string coarse_cells_doubt(double cell_m);

/// That -simplify leaves little of a building: it is more than 100 cells wide. Without a full stop; "" where
/// it is less. @param tolerance, cell in units of the DEM's CRS
[[nodiscard]] std::string tolerance_doubt(double tolerance, double cell);

}  // namespace d2b

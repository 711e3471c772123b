#pragma once

#include <functional>

#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "core/grid.hpp"
#include "core/lattice.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Square metres of a unit square at a place; constant on a projected grid. Any thread may ask.
using SquareArea = std::function<double(LatticePoint)>;

/// Square metres of a cell, as areas are measured for the output: geodesic where the CRS is on an ellipsoid,
/// taken once for each block of 256 x 256 cells of the absolute grid, in its middle or as near to that as the
/// raster reaches. @param raster all squares of the whole raster, whatever the window
[[nodiscard]] SquareArea make_square_area(const Georeference& georeference, const Crs& crs,
                                          const LatticeBox& raster);

/// Metres of a cell's side, from its area, in the middle of a window.
[[nodiscard]] double cell_size_m(const Window& window, const SquareArea& area);

/// Length on the ground of a unit of x over that of a unit of y, in the middle of a window.
[[nodiscard]] double x_stretch(const Georeference& georeference, const Crs& crs, const Window& window);

/// Metres of one step along a row and along a column, in the middle of a window, a millimetre at least, and
/// how they lie to each other.
[[nodiscard]] CellSize cell_steps(const Window& window, const Georeference& georeference, const Crs& crs);

}  // namespace d2b

#pragma once

#include <functional>

#include "core/crs.hpp"
#include "core/georeference.hpp"
#include "core/grid.hpp"
#include "core/lattice.hpp"
#include "dem2buildings/dem_source.hpp"

namespace d2b {

/// Area in m2 of the unit square at a lattice point; constant on a projected grid. Thread-safe.
using SquareArea = std::function<double(LatticePoint)>;

/// Returns cell areas in m2 as measured for the output: geodesic if the CRS is on an ellipsoid, computed once
/// per block of 256 x 256 cells of the absolute grid, at its centre or as near to it as the raster reaches.
/// @param raster all squares of the whole raster, whatever the window
[[nodiscard]] SquareArea make_square_area(const Georeference& georeference, const Crs& crs,
                                          const LatticeBox& raster);

/// Returns the side of a cell in metres, from its area, at the centre of a window.
[[nodiscard]] double cell_size_m(const Window& window, const SquareArea& area);

/// Returns the ground length of a unit of x divided by that of a unit of y, at the centre of a window.
[[nodiscard]] double x_stretch(const Georeference& georeference, const Crs& crs, const Window& window);

/// Returns the cell size in metres at the centre of a window, with the angle between rows and columns. At
/// least a millimetre.
[[nodiscard]] CellSize cell_steps(const Window& window, const Georeference& georeference, const Crs& crs);

}  // namespace d2b

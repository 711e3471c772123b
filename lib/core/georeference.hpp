#pragma once

#include <cstdint>
#include <functional>

#include "core/crs.hpp"
#include "core/grid.hpp"
#include "core/lattice.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Converts rows and columns to coordinates; nothing else does. Each position is computed from its integers
/// alone, so equal lattice points give equal positions, and lines along a row or column of an unrotated grid
/// stay exactly straight.
class Georeference {
  public:
    /// @param mode decides whether lattice points are cell centres or cell corners, half a cell apart
    Georeference(const AffineTransform& transform, TraceMode mode);

    /// @param divisor of the row and column, a power of two, for points between those of the fine lattice
    [[nodiscard]] Position position(FinePoint point, std::int64_t divisor = 1) const;
    [[nodiscard]] Position position(LatticePoint point) const { return position(fine(point)); }
    /// Returns the corners of a box, starting at the low one, along the column first.
    [[nodiscard]] WorldRing corners(const LatticeBox& box) const;
    /// Returns exterior rings counter-clockwise with y up, whichever way the raster's rows run.
    /// @param divisor as in position()
    [[nodiscard]] WorldPolygon polygon(const FinePolygon& polygon, std::int64_t divisor = 1) const;
    [[nodiscard]] WorldPolygon polygon(const LatticePolygon& traced) const { return polygon(fine(traced)); }
    /// Returns the vector of a step of rows and columns, in units of the CRS.
    [[nodiscard]] Position step(double rows, double cols) const;
    /// Returns the area of a cell, in square units of the CRS.
    [[nodiscard]] double cell_area() const;
    /// Returns true if rows run in the direction of y, so that rings are reversed about their first vertices.
    [[nodiscard]] bool mirrored() const { return mirrored_; }
    /// Returns true if rows and columns run along the axes.
    [[nodiscard]] bool axis_parallel() const { return transform_[2] == 0 && transform_[4] == 0; }
    /// Returns true if rows and columns run along the axes and the coordinates of neighbouring lines of a
    /// window remain distinct and ordered after rounding. Polygons that are valid on the lattice are then
    /// valid in coordinates.
    [[nodiscard]] bool is_exact(const Window& window) const;

  private:
    [[nodiscard]] WorldRing ring(const FineRing& ring, std::int64_t divisor) const;

    AffineTransform transform_;
    double shift_;   ///< 0.5 if lattice points are centres
    bool mirrored_;  ///< rows run in the direction of y, so orientations are reversed
};

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

#pragma once

#include "core/lattice.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// The one place where rows and columns become coordinates. Each position is computed from its integers
/// alone, so equal lattice points are equal positions, and what is straight along a row or column of an
/// unrotated grid stays so exactly.
class Georeference {
  public:
    /// @param mode grid points are the cells' centres, corners of cells are half a cell off them
    Georeference(const AffineTransform& transform, TraceMode mode);

    [[nodiscard]] Position position(FinePoint point) const;
    [[nodiscard]] Position position(LatticePoint point) const { return position(fine(point)); }
    /// Of a box, around it from the low one, along the column first.
    [[nodiscard]] WorldRing corners(const LatticeBox& box) const;
    /// Exterior rings counter-clockwise with y up, whichever way the raster's rows run.
    [[nodiscard]] WorldPolygon polygon(const FinePolygon& polygon) const;
    [[nodiscard]] WorldPolygon polygon(const LatticePolygon& traced) const { return polygon(fine(traced)); }
    /// A step of rows and columns, in units of the CRS.
    [[nodiscard]] Position step(double rows, double cols) const;
    /// Of a cell, in square units of the CRS.
    [[nodiscard]] double cell_area() const;
    /// Whether rows and columns run along the axes.
    [[nodiscard]] bool axis_parallel() const { return transform_[2] == 0 && transform_[4] == 0; }
    /// Whether rows and columns run along the axes and neighbouring ones of a window have coordinates that
    /// rounding keeps apart, in their order: what is valid on the lattice is so in coordinates.
    [[nodiscard]] bool is_exact(const Window& window) const;

  private:
    [[nodiscard]] WorldRing ring(const FineRing& ring) const;

    AffineTransform transform_;
    double shift_;   ///< 0.5 where lattice points are centres
    bool mirrored_;  ///< the raster's rows run with y, so orientations turn over
};

}  // namespace d2b

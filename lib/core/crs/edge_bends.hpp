#pragma once

#include <cmath>
#include <map>
#include <span>

#include "core/crs/geodesic_polygon.hpp"
#include "core/crs/lon_lat.hpp"
#include "core/crs/position_math.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Curvature of straight edges of a CRS on the ellipsoid. Computed once per tile of a fixed grid over the
/// CRS, so that results do not depend on earlier rings.
class EdgeBends {
  public:
    /// @param tile side of the smallest tiles, units of the CRS
    explicit EdgeBends(double tile) : tile_(tile) {}

    /// Returns the length over which the bend may be considered constant, in units of the CRS.
    [[nodiscard]] double tile() const { return tile_; }
    /// Returns the bend near a ring: no edge there has a sag (in metres) above bend * length^2 (in units of
    /// the CRS). Infinite if the ring is too large to tell. @param corners at least one @param lon_lat,
    /// polygon of the CRS, the same in every call
    [[nodiscard]] double around(std::span<const Position> corners, const LonLat& lon_lat,
                                const GeodesicPolygon& polygon);

  private:
    [[nodiscard]] double tile_size(int level) const { return std::ldexp(tile_, level); }
    [[nodiscard]] double measure(const MapTile& tile, const LonLat& lon_lat,
                                 const GeodesicPolygon& polygon) const;

    double tile_;
    std::map<MapTile, double> bends_;
};

}  // namespace d2b

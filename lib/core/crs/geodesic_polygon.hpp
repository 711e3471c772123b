#pragma once

#include <span>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/PolygonArea.hpp>

#include "core/crs.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Polygons of geodesics on an ellipsoid. Positions are longitudes and latitudes in degrees.
class GeodesicPolygon {
  public:
    GeodesicPolygon(double radius, double flattening) : earth_(radius, flattening), wide_(earth_) {}

    /// @param places at least one
    [[nodiscard]] Geodesy::Measure measure(std::span<const Position> places);
    /// Returns the distance in metres of the midpoint of an edge from the geodesic a b, measured across it,
    /// because the midpoint of the edge need not be that of the geodesic. Accurate to some nanometres.
    [[nodiscard]] double sag(const Position& a, const Position& middle, const Position& b) const;

  private:
    [[nodiscard]] Geodesy::Measure measure_near(std::span<const Position> places) const;

    GeographicLib::Geodesic earth_;
    GeographicLib::PolygonArea wide_;
};

}  // namespace d2b

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
    /// Distance of the middle of an edge from the geodesic a b, metres. Only across: the middle of the edge
    /// need not be the middle of the geodesic. Good to some nanometres.
    [[nodiscard]] double sag(const Position& a, const Position& middle, const Position& b) const;

  private:
    [[nodiscard]] Geodesy::Measure measure_near(std::span<const Position> places) const;

    GeographicLib::Geodesic earth_;
    GeographicLib::PolygonArea wide_;
};

}  // namespace d2b

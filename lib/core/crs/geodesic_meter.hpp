#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/crs.hpp"
#include "core/crs/edge_bends.hpp"
#include "core/crs/geodesic_polygon.hpp"
#include "core/crs/local_metric.hpp"
#include "core/crs/lon_lat.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Rings whose edges are straight in a CRS: those of a few kilometres from the metric of their place, others,
/// and those near poles and the like, from polygons of geodesics.
///
/// An edge and the geodesic between its ends enclose about 2/3 * length * sag, where sag is the distance of
/// the edge's middle from the geodesic. With no sag above 3/2 * share * area / perimeter, what all edges
/// leave out is below `share` of the area; an edge in n pieces sags by 1/n^2. Because the sag of a short edge
/// is at most bend * length^2, where bend is a property of the place, short edges need not be looked at.
class GeodesicMeter {
  public:
    /// @param name  of the CRS
    /// @param step  length in units of the CRS above which edges are cut without looking
    /// @param turn  units of the CRS in a full circle of longitude, 0 where the coordinates are no angles
    GeodesicMeter(std::unique_ptr<LonLat> lon_lat, std::string name, double step, double turn,
                  StopRequest stop)
        : lon_lat_(std::move(lon_lat)),
          name_(std::move(name)),
          step_(step),
          turn_(turn),
          stop_(std::move(stop)),
          polygon_(lon_lat_->radius, lon_lat_->flattening),
          metrics_(step / 8),
          bends_(step / 8) {}

    /// @throws InputError where a position has no longitude and latitude
    [[nodiscard]] Geodesy::Measure ring(std::span<const Position> ring);

  private:
    [[nodiscard]] Position edge(std::size_t corner) const;
    [[nodiscard]] double longest_squared() const;
    void locate(std::span<const Position> positions, std::span<Position> places) const;
    [[nodiscard]] Position locate(const Position& position) const;
    void cut_long_edges();
    [[nodiscard]] Geodesy::Measure measure_cut();
    void cut(const Position& start, const Position& along, const Position& a, const Position& b,
             int halvings);

    std::unique_ptr<LonLat> lon_lat_;
    std::string name_;
    double step_;
    double turn_;
    StopRequest stop_;
    GeodesicPolygon polygon_;
    LocalMetrics metrics_;
    EdgeBends bends_;
    // Of the ring at hand, kept for their memory.
    std::vector<Position> corners_;  ///< in the CRS
    std::vector<Position> places_;   ///< of the corners
    std::vector<Position> outline_;  ///< places of the corners and of the pieces between them
    double largest_sag_ = 0;         ///< metres
    double harmless_squared_ = 0;    ///< units of the CRS, squared
    std::size_t most_places_ =
        0;  ///< of the outline: a ring as narrow as a hair and round the Earth ends, too
};

}  // namespace d2b

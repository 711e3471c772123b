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

/// Measures rings whose edges are straight in a CRS. Rings of up to a few kilometres use the local metric;
/// others, and those near poles, are densified into polygons of geodesics.
///
/// An edge and the geodesic between its ends enclose about 2/3 * length * sag, where sag is the distance of
/// the edge's midpoint from the geodesic. If no sag exceeds 3/2 * share * area / perimeter, the total error
/// is below `share` of the area; an edge in n pieces sags by 1/n^2. Because the sag of a short edge is at
/// most bend * length^2, and the bend depends only on the location, short edges need not be checked.
class GeodesicMeter {
  public:
    /// @param name of the CRS @param step length in units of the CRS above which edges are always divided
    /// @param turn full circle of longitude in units of the CRS, 0 if the coordinates are not angles
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

    /// @throws InputError if a position has no longitude and latitude
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
    // State of the current ring, kept to reuse memory.
    std::vector<Position> corners_;  ///< coordinates in the CRS
    std::vector<Position> places_;   ///< longitude and latitude of the corners
    std::vector<Position>
        outline_;             ///< longitude and latitude of the corners and of the points added between them
    double largest_sag_ = 0;  ///< metres
    double harmless_squared_ = 0;  ///< squared length of edges that need no division, in units of the CRS
    std::size_t most_places_ = 0;  ///< limit of outline_, so that a sliver around the Earth terminates, too
};

}  // namespace d2b

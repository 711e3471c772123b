#pragma once

#include <cmath>
#include <memory>
#include <span>

#include <proj.h>

#include "core/crs/proj.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

[[nodiscard]] inline bool is_finite(const Position& p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

[[nodiscard]] inline double squared_length(const Position& v) {
    return v.x * v.x + v.y * v.y;
}

/// @param share of the way along an edge from its start
[[nodiscard]] inline Position point_along(const Position& start, const Position& along, double share) {
    return {start.x + along.x * share, start.y + along.y * share};
}

/// Conversion from a CRS to degrees of longitude and latitude on its own datum, without a datum shift.
struct LonLat {
    ProjContext context;
    PjPtr operation;            ///< null if the coordinates are longitude and latitude already
    double degrees = 1;         ///< degrees in one unit of the operation's output
    double prime_meridian = 0;  ///< degrees east of Greenwich
    double radius = 0;          ///< equatorial, metres
    double flattening = 0;

    /// Copies for another thread. Saves the milliseconds in which PROJ searches for the operation. @returns
    /// null if PROJ fails
    [[nodiscard]] std::unique_ptr<LonLat> copy() const;

    /// Converts in place; positions that cannot be converted become infinite or NaN.
    void apply(std::span<Position> positions) const;
};

/// @returns null if the CRS has no longitudes and latitudes, or PROJ does not know its projection
[[nodiscard]] std::unique_ptr<LonLat> lon_lat_of(const PJ* horizontal);

struct AreaDelete {
    void operator()(PJ_AREA* area) const { proj_area_destroy(area); }
};
using AreaPtr = std::unique_ptr<PJ_AREA, AreaDelete>;

/// @param crs of the positions @returns null if the area is unknown; PROJ then uses the CRSs' areas of use
[[nodiscard]] AreaPtr area_of(const PJ* crs, std::span<const Position> positions);

}  // namespace d2b

#pragma once

#include <memory>
#include <span>

#include <proj.h>

#include "core/crs/proj_objects.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

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

}  // namespace d2b

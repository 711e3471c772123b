#pragma once

#include <memory>
#include <span>

#include <proj.h>

#include "core/crs/proj_objects.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// From a CRS to degrees of longitude and latitude on its own datum; no datum shift.
struct LonLat {
    ProjContext context;
    PjPtr operation;            ///< null where the coordinates are longitude and latitude already
    double degrees = 1;         ///< in one unit of what the operation gives
    double prime_meridian = 0;  ///< degrees east of Greenwich
    double radius = 0;          ///< equatorial, metres
    double flattening = 0;

    /// The same for another thread: PROJ need not look for the operation once more, which takes milliseconds.
    /// @returns null where PROJ cannot
    [[nodiscard]] std::unique_ptr<LonLat> copy() const;

    /// In place; positions without image become infinite or NaN.
    void apply(std::span<Position> positions) const;
};

/// @returns null where the CRS has no longitudes and latitudes, or PROJ does not know its projection
[[nodiscard]] std::unique_ptr<LonLat> lon_lat_of(const PJ* horizontal);

}  // namespace d2b

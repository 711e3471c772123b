#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
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

/// Square of a fixed grid over a CRS. The size of tiles doubles from level to level.
struct MapTile {
    int level = 0;
    std::int64_t col = 0;
    std::int64_t row = 0;
    auto operator<=>(const MapTile&) const = default;
};

/// Returns a tile near whose centre a ring lies, on the lowest level on which the ring is no larger than a
/// tile. @param corners at least one @param smallest side of the tiles of level 0 @returns nothing if no
/// level below `levels` is large enough, or a position is not finite or too far away
[[nodiscard]] inline std::optional<MapTile> tile_around(std::span<const Position> corners, double smallest,
                                                        int levels) {
    constexpr double farthest = 1e15;  // tiles; up to here they are numbered exactly
    Position low = corners[0];
    Position high = corners[0];
    for (const Position& p : corners) {
        if (!is_finite(p))
            return std::nullopt;
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    MapTile tile;
    while (tile.level < levels && std::ldexp(smallest, tile.level) < std::max(high.x - low.x, high.y - low.y))
        ++tile.level;
    const double size = std::ldexp(smallest, tile.level);
    const Position place{(low.x + high.x) / 2 / size, (low.y + high.y) / 2 / size};
    if (tile.level == levels || !(std::max(std::abs(place.x), std::abs(place.y)) < farthest))
        return std::nullopt;
    tile.col = std::llround(place.x);
    tile.row = std::llround(place.y);
    return tile;
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

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

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

}  // namespace d2b

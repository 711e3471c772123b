#include "core/crs/edge_bends.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

namespace d2b {

double EdgeBends::around(std::span<const Position> corners, const LonLat& lon_lat,
                         const GeodesicPolygon& polygon) {
    constexpr int levels = 8;
    const std::optional<MapTile> tile = tile_around(corners, tile_, levels);
    if (!tile)
        return std::numeric_limits<double>::infinity();  // then every edge is checked
    const auto [found, is_new] = bends_.try_emplace(*tile);
    if (is_new)
        found->second = measure(*tile, lon_lat, polygon);
    return found->second;
}

/// Takes the largest sag of chords in four directions on a lattice of 5 x 5 positions that extends one tile
/// size to all sides of the tile's centre (as far as a ring no larger than the tile reaches), doubled because
/// of the gaps between them.
double EdgeBends::measure(const MapTile& tile, const LonLat& lon_lat, const GeodesicPolygon& polygon) const {
    constexpr int n = 5;
    const double size = tile_size(tile.level);
    std::array<Position, std::size_t{n} * n> places;
    const auto place = [&](int col, int row) -> Position& {
        return places[static_cast<std::size_t>(row) * n + static_cast<std::size_t>(col)];
    };
    for (int row = 0; row < n; ++row)
        for (int col = 0; col < n; ++col)
            place(col, row) = {(static_cast<double>(tile.col) + col / 2.0 - 1) * size,
                               (static_cast<double>(tile.row) + row / 2.0 - 1) * size};
    lon_lat.apply(places);
    if (!std::all_of(places.begin(), places.end(), is_finite))
        return std::numeric_limits<double>::infinity();

    static constexpr std::array<std::pair<int, int>, 4> directions{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
    const auto inside = [](int index, int reach) {
        return index >= std::abs(reach) && index + std::abs(reach) < n;
    };
    double largest = 0;
    for (const auto& [dx, dy] : directions)
        for (int row = 0; row < n; ++row)
            for (int col = 0; col < n; ++col)
                if (inside(col, dx) && inside(row, dy))
                    largest = std::max(largest, polygon.sag(place(col - dx, row - dy), place(col, row),
                                                            place(col + dx, row + dy)) /
                                                    (size * size * (dx * dx + dy * dy)));
    return 2 * largest;
}

}  // namespace d2b

#pragma once

#include <cstdint>
#include <vector>

#include "core/byte_record.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/world_polygon.hpp"
#include "features/feature_writer.hpp"
#include "tiles/drawn_tile.hpp"

namespace d2b {

/// Results of step merge for a tile whose features go into separate files. Contours of the tile drawn by
/// merge, with their numbers, follow in the payload of the file.
struct NumberedTile {
    GivenNumbers numbers;  ///< numbers of the contours drawn by step draw
    std::vector<DrawnBlock> left;
};
void save(const NumberedTile& tile, ByteWriter& writer);
/// Deserialises a tile. @throws BrokenRecord
[[nodiscard]] NumberedTile load_numbered_tile(ByteReader& reader);

/// Layer that tiles write in parts.
struct NumberedLayer {
    std::int64_t features = 0;
    Position least{};  ///< bounds of all vertices; 0 if there are none
    Position most{};
    std::vector<std::int64_t> tiles;  ///< tiles with features in it, ascending

    /// Adds a feature. @param tile not before those of features added earlier
    void add(std::int64_t tile, const std::vector<WorldPolygon>& parts);
};

/// Results of step merge for all tiles.
struct NumberedWhole {
    std::int32_t levels = 1;  ///< number of levels of the tallest stack, including the root
    std::vector<NumberedLayer> layers;
};
void save(const NumberedWhole& whole, ByteWriter& writer);
/// @param tiles number of tiles of the plan @throws BrokenRecord
[[nodiscard]] NumberedWhole load_numbered_whole(ByteReader& reader, std::int64_t tiles);

}  // namespace d2b

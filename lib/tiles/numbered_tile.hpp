#pragma once

#include <cstdint>
#include <vector>

#include "core/byte_record.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/world_polygon.hpp"
#include "features/feature_writer.hpp"
#include "tiles/drawn_tile.hpp"

namespace d2b {

/// What merge says to a tile whose features go into files of their own. Contours of the tile that merge has
/// drawn follow in the tail of the file, with their numbers.
struct NumberedTile {
    GivenNumbers numbers;  ///< of the contours that draw has drawn
    std::vector<DrawnBlock> left;
};
void save(const NumberedTile& tile, ByteWriter& writer);
/// @throws BrokenRecord
[[nodiscard]] NumberedTile load_numbered_tile(ByteReader& reader);

/// A layer that tiles write in parts.
struct NumberedLayer {
    std::int64_t features = 0;
    Position least{};  ///< of the vertices of all; 0 where there are none
    Position most{};
    std::vector<std::int64_t> tiles;  ///< that have features in it, ascending

    /// @param tile not before those of the features that were added
    void add(std::int64_t tile, const std::vector<WorldPolygon>& parts);
};

/// What merge says to all tiles.
struct NumberedWhole {
    std::int32_t levels = 1;  ///< of the building with most, the root counted
    std::vector<NumberedLayer> layers;
};
void save(const NumberedWhole& whole, ByteWriter& writer);
/// @param tiles of the plan @throws BrokenRecord
[[nodiscard]] NumberedWhole load_numbered_whole(ByteReader& reader, std::int64_t tiles);

}  // namespace d2b

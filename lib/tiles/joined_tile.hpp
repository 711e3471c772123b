#pragma once

#include <cstdint>
#include <vector>

#include "core/byte_record.hpp"
#include "core/label.hpp"
#include "dem2buildings/dem_source.hpp"
#include "detect/detection.hpp"

namespace d2b {

/// Certain or possible building that a tile draws.
struct JoinedBuilding {
    bool is_building = false;
    Doubt doubt = Doubt::rough;
    double ground = 0;  ///< elevation in m; NaN if unknown
    double confidence = 0;
    std::int64_t parcel = ParcelCell::nobody;
};

/// Mapping from the labels of a unit to those of a tile.
struct JoinedUnit {
    std::int64_t unit = 0;      ///< number of the unit, row by row
    std::vector<Label> number;  ///< indexed by the label in the unit: 0 if rejected, 1 to n for a building of
                                ///< the tile, n + 1 for one of another tile
};

/// Results of step join for a tile: its buildings and their location.
struct JoinedTile {
    std::vector<JoinedBuilding> buildings;  ///< possible buildings come last
    Window window;  ///< bounds of their cells and of the surroundings needed to draw them; empty if there are
                    ///< no buildings
    std::vector<JoinedUnit> units;  ///< units whose cores overlap the window

    /// Number of certain buildings.
    [[nodiscard]] Label sure() const;
    [[nodiscard]] Label other() const { return static_cast<Label>(buildings.size() + 1); }
};
void save(const JoinedTile& tile, ByteWriter& writer);
/// @param window of the whole raster @param units number of units in it @throws BrokenRecord
[[nodiscard]] JoinedTile load_joined_tile(ByteReader& reader, const Window& window, std::int64_t units);

}  // namespace d2b

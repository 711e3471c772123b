#pragma once

#include <cstdint>
#include <vector>

#include "core/byte_record.hpp"
#include "core/label.hpp"
#include "dem2buildings/dem_source.hpp"
#include "detect/detection.hpp"

namespace d2b {

/// A building, or what may be one, that a tile draws.
struct JoinedBuilding {
    bool is_building = false;
    Doubt doubt = Doubt::rough;
    double ground = 0;  ///< elevation, m; NaN where it is not known
    double confidence = 0;
    std::int64_t parcel = ParcelCell::nobody;
};

/// What the labels of a unit are to a tile.
struct JoinedUnit {
    std::int64_t unit = 0;      ///< its number, row by row
    std::vector<Label> number;  ///< by the unit's label: 0 left out, a building of the tile's from 1 on, or
                                ///< one more than these: of another tile
};

/// What join says to a tile: its buildings, and where they are.
struct JoinedTile {
    std::vector<JoinedBuilding> buildings;  ///< what may be one comes last
    Window
        window;  ///< around all their cells, with what is drawn and looked at around them; empty: no building
    std::vector<JoinedUnit> units;  ///< with own cells in the window

    /// Of the buildings that are none for sure.
    [[nodiscard]] Label sure() const;
    [[nodiscard]] Label other() const { return static_cast<Label>(buildings.size() + 1); }
};
void save(const JoinedTile& tile, ByteWriter& writer);
/// @param window of the whole @param units in it @throws BrokenRecord
[[nodiscard]] JoinedTile load_joined_tile(ByteReader& reader, const Window& window, std::int64_t units);

}  // namespace d2b

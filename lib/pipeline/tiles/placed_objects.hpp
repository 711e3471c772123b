#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "pipeline/tiles/seam_objects.hpp"
#include "pipeline/tiles/tile_grid.hpp"
#include "tiles/joined_tile.hpp"

namespace d2b {

/// Detected object assigned to the tile that draws it.
struct PlacedObject {
    SeenObject seen;
    Window box;
    std::int64_t unit = 0;      ///< first unit that contains it
    Label label = 0;            ///< label in that unit
    std::size_t joined = none;  ///< index among the objects joined at seams; none if it does not cross one

    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    /// Sort key: buildings first, then low-confidence candidates; each in the order of units.
    [[nodiscard]] auto order() const { return std::tuple(!seen.is_building, unit, label); }
};

/// Assigns objects to tiles. An object that crosses seams goes to the tile that has most of its cells.
class PlacedObjects {
  public:
    /// @param tiles, interior, seams must outlive this
    PlacedObjects(const TileGrid& tiles, const LoneObjects& lone, const SeamObjects& seams)
        : tiles_(tiles), lone_(lone), seams_(seams) {}

    /// @param seen objects at seams, by the merger's label @param merged result of the merger
    void place(std::vector<SeamObject> seen, UnitMerger::Merged merged);
    /// Returns the objects that a tile draws, sorted by order().
    [[nodiscard]] std::vector<PlacedObject> of(std::int64_t tile) const;
    /// Maps the labels of a unit to those of a tile with these objects. @param number of the unit
    [[nodiscard]] JoinedUnit labels_for(std::int64_t number, const std::vector<PlacedObject>& objects) const;

  private:
    const TileGrid& tiles_;
    const LoneObjects& lone_;
    const SeamObjects& seams_;
    /// Index of the merged object plus one, by the merger's label; 0 if rejected.
    std::vector<Label> number_;
    std::vector<PlacedObject> crossing_;  ///< objects that cross seams, sorted by drawing tile
    std::vector<std::int64_t> drawn_by_;  ///< drawing tile of each
};

}  // namespace d2b

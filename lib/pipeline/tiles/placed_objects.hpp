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

/// A building, or what may be one, of a tile.
struct PlacedObject {
    SeenObject seen;
    Window box;
    std::int64_t unit = 0;      ///< the first that saw it
    Label label = 0;            ///< in that unit
    std::size_t joined = none;  ///< place among what is joined at seams; none: it lies at none

    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    /// What is doubtful comes last, and objects in the order of units.
    [[nodiscard]] auto order() const { return std::tuple(!seen.is_building, unit, label); }
};

/// Which tile draws which object: one that lies at seams goes to the tile that has most of its cells.
class PlacedObjects {
  public:
    /// @param tiles, lone, seams must outlive this
    PlacedObjects(const TileGrid& tiles, const LoneObjects& lone, const SeamObjects& seams)
        : tiles_(tiles), lone_(lone), seams_(seams) {}

    /// @param seen of the seams, by the merger's label @param merged what the merger made of them
    void place(std::vector<SeamObject> seen, UnitMerger::Merged merged);
    /// Those that a tile draws, in their order.
    [[nodiscard]] std::vector<PlacedObject> of(std::int64_t tile) const;
    /// What a unit's labels are to a tile with these objects. @param number of the unit
    [[nodiscard]] JoinedUnit labels_for(std::int64_t number, const std::vector<PlacedObject>& objects) const;

  private:
    const TileGrid& tiles_;
    const LoneObjects& lone_;
    const SeamObjects& seams_;
    std::vector<Label> number_;           ///< place of an object plus one, by the merger's label; 0: left out
    std::vector<PlacedObject> crossing_;  ///< objects at seams, by the tile that draws them
    std::vector<std::int64_t> drawn_by_;  ///< that tile, likewise
};

}  // namespace d2b

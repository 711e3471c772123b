#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "dem2buildings/report.hpp"
#include "dem2buildings/spool.hpp"
#include "detect/units.hpp"
#include "pipeline/tiles/found_tile.hpp"
#include "pipeline/tiles/tile_run.hpp"

namespace d2b::tiles {

/// Object that does not touch a seam, so only its unit contains it.
struct InteriorObject {
    detect::SeenObject seen;
    Window box;
    Label label = 0;  ///< label in its unit
};

/// Objects of a unit, divided by the join step.
struct UnitObjects {
    /// Kind of a label: `left_out`, `interior`, or the index of its object among those at seams, plus one.
    using Mark = std::uint32_t;
    static constexpr Mark left_out = 0;
    static constexpr Mark interior = std::numeric_limits<Mark>::max();

    std::vector<Mark> marks;                       ///< by label - 1
    std::vector<Window> boxes;                     ///< of their cells in the core of the unit; likewise
    std::vector<InteriorObject> interior_objects;  ///< sorted by label
    std::vector<Label> at_seams;                   ///< labels in ascending order
};

/// Selection rules for objects that do not touch a seam.
struct InteriorRules {
    std::int64_t min_cells = 1;  ///< objects with fewer cells are rejected
    bool doubtful = false;       ///< true to keep low-confidence candidates
};
/// @param tally counts the interior objects with enough cells that are doubtful or left out
[[nodiscard]] UnitObjects divide_objects(const FoundUnit& unit, const InteriorRules& rules, Tally& tally);

/// Spools interior objects until all seams are known, because they may not fit in memory.
class InteriorObjects {
  public:
    /// @param units number of units
    InteriorObjects(std::unique_ptr<Spool> spool, std::size_t units)
        : spool_(std::move(spool)), kept_(units) {}

    /// @throws OutputError the spool is full
    void put(std::int64_t unit, const UnitObjects& objects);
    [[nodiscard]] std::vector<UnitObjects::Mark> marks(std::int64_t unit) const;
    [[nodiscard]] std::vector<InteriorObject> interior_objects(std::int64_t unit) const;

  private:
    struct Kept {
        SpoolEntry marks;
        SpoolEntry interior_objects;
    };
    std::unique_ptr<Spool> spool_;
    std::vector<Kept> kept_;  ///< by unit
};

/// Part of an object at a seam, seen from one unit.
struct BorderObject {
    Window box;              ///< bounding box of its cells among the unit's own
    std::int64_t cells = 0;  ///< number of these cells
    std::int64_t unit = 0;
    Label label = 0;  ///< label in the unit
    Label whole = 0;  ///< label of its whole object in the unit
};

/// Objects at the seams of all units. Units are added in any order but compared row by row, so that the edges
/// of a unit, which are as long as it is wide, are freed early.
class BorderObjects {
  public:
    /// @param units number of units @param cols units per row
    BorderObjects(std::size_t units, std::int32_t cols)
        : cols_(cols), units_(units), known_(units), first_(units), seams_(cols) {}

    /// @param number of the unit @param divided its objects
    void put(std::int64_t number, FoundUnit&& found, const UnitObjects& divided);
    /// Compares units in order, up to the first one that has not been added.
    void compare_known();

    [[nodiscard]] detect::UnitMerger& merger() { return merger_; }
    /// Returns the merger's label of an object. @param mark of the unit's own label, not left_out or
    /// interior
    [[nodiscard]] Label label(std::int64_t unit, UnitObjects::Mark mark) const {
        return first_[static_cast<std::size_t>(unit)] + mark;
    }
    /// Moves out all objects, indexed by the merger's label; index 0 is not used.
    [[nodiscard]] std::vector<BorderObject> take();

  private:
    /// Seam objects of a unit until it has been compared.
    struct Unit {
        std::vector<detect::SeenObject> objects;
        std::vector<BorderObject> places;  ///< location of each object
        detect::UnitEdges edges;
    };
    void compare_next();

    std::int32_t cols_;
    std::vector<Unit> units_;
    std::vector<bool> known_;   ///< by unit
    std::vector<Label> first_;  ///< by unit: offset from its seam object indices to the merger's labels
    std::size_t next_ = 0;      ///< next unit to compare
    std::vector<BorderObject> seen_{{}};
    detect::UnitMerger merger_;
    detect::UnitSeams seams_;
};

/// Detected object assigned to the tile that draws it.
struct AssignedObject {
    detect::SeenObject seen;
    Window box;
    std::int64_t unit = 0;      ///< first unit that contains it
    Label label = 0;            ///< label in that unit
    std::size_t joined = none;  ///< index among the objects joined at seams; none if it does not cross one
    std::int64_t whole = 0;     ///< as in JoinedBuilding

    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    /// Sort key: buildings first, then low-confidence candidates; each in the order of units.
    [[nodiscard]] auto order() const { return std::tuple(!seen.is_building, unit, label); }
};

/// Assigns objects to tiles. An object that crosses seams goes to the tile that has most of its cells.
class ObjectAssignment {
  public:
    /// @param tiles, interior, seams must outlive this
    ObjectAssignment(const TileGrid& tiles, const InteriorObjects& interior, const BorderObjects& seams)
        : tiles_(tiles), interior_(interior), seams_(seams) {}

    /// @param seen objects at seams, by the merger's label @param merged result of the merger
    void place(std::vector<BorderObject> seen, detect::UnitMerger::Merged merged);
    /// Returns the objects that a tile draws, sorted by order().
    [[nodiscard]] std::vector<AssignedObject> of(std::int64_t tile) const;
    /// Maps the labels of a unit to those of a tile with these objects. @param number of the unit
    [[nodiscard]] JoinedUnit map_labels(std::int64_t number,
                                        const std::vector<AssignedObject>& objects) const;

  private:
    /// Whole in a unit of which a part touches a seam.
    struct SeamWhole {
        std::int64_t unit = 0;
        Label whole = 0;  ///< label in the unit
        Label name = 0;   ///< merger's label, which is the same in all units
    };
    /// Adds the objects of a unit that do not touch a seam.
    void add_interior(std::int64_t unit, std::vector<AssignedObject>& objects) const;

    const TileGrid& tiles_;
    const InteriorObjects& interior_;
    const BorderObjects& seams_;
    /// Index of the merged object plus one, by the merger's label; 0 if rejected.
    std::vector<Label> number_;
    std::vector<AssignedObject> crossing_;  ///< objects that cross seams, sorted by drawing tile
    std::vector<std::int64_t> drawn_by_;    ///< drawing tile of each
    std::vector<SeamWhole> wholes_;         ///< sorted by unit and whole
};

}  // namespace d2b::tiles

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "detect/merge_units.hpp"
#include "detect/unit_seams.hpp"
#include "pipeline/tiles/unit_objects.hpp"

namespace d2b {

/// Part of an object at a seam, seen from one unit.
struct SeamObject {
    Window box;              ///< bounding box of its cells among the unit's own
    std::int64_t cells = 0;  ///< number of these cells
    std::int64_t unit = 0;
    Label label = 0;  ///< label in the unit
};

/// Objects at the seams of all units. Units are added in any order but compared row by row, so that the edges
/// of a unit, which are as long as it is wide, are freed early.
class SeamObjects {
  public:
    /// @param units number of units @param cols units per row
    SeamObjects(std::size_t units, std::int32_t cols)
        : cols_(cols), units_(units), known_(units), first_(units), seams_(cols) {}

    /// @param number of the unit @param divided its objects
    void put(std::int64_t number, FoundUnit&& found, const UnitObjects& divided);
    /// Compares units in order, up to the first one that has not been added.
    void compare_known();

    [[nodiscard]] UnitMerger& merger() { return merger_; }
    /// Returns the merger's label of an object. @param mark of the unit's own label, not left_out or
    /// interior
    [[nodiscard]] Label label(std::int64_t unit, UnitObjects::Mark mark) const {
        return first_[static_cast<std::size_t>(unit)] + mark;
    }
    /// Moves out all objects, indexed by the merger's label; index 0 is not used.
    [[nodiscard]] std::vector<SeamObject> take();

  private:
    /// Seam objects of a unit until it has been compared.
    struct Unit {
        std::vector<SeenObject> objects;
        std::vector<SeamObject> places;  ///< location of each object
        UnitEdges edges;
    };
    void compare_next();

    std::int32_t cols_;
    std::vector<Unit> units_;
    std::vector<bool> known_;   ///< by unit
    std::vector<Label> first_;  ///< by unit: offset from its seam object indices to the merger's labels
    std::size_t next_ = 0;      ///< next unit to compare
    std::vector<SeamObject> seen_{{}};
    UnitMerger merger_;
    UnitSeams seams_;
};

}  // namespace d2b

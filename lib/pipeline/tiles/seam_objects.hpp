#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "detect/merge_units.hpp"
#include "detect/unit_seams.hpp"
#include "pipeline/tiles/unit_objects.hpp"

namespace d2b {

/// An object at a seam, as a unit saw it.
struct SeamObject {
    Window box;              ///< around those of its cells that are the unit's own
    std::int64_t cells = 0;  ///< likewise
    std::int64_t unit = 0;
    Label label = 0;  ///< of the unit
};

/// What all units saw of the seams between them. Units come in any order; they are compared row by row, since
/// the lines beside a unit's seams are as long as it is wide, so they go as soon as they can.
class SeamObjects {
  public:
    /// @param units that there are @param cols of them in a row
    SeamObjects(std::size_t units, std::int32_t cols)
        : cols_(cols), units_(units), known_(units), first_(units), seams_(cols) {}

    /// @param number of the unit @param divided its objects
    void put(std::int64_t number, FoundUnit&& found, const UnitObjects& divided);
    /// Compares the units that are known, up to the first that is not.
    void compare_known();

    [[nodiscard]] UnitMerger& merger() { return merger_; }
    /// The merger's label of an object. @param mark what the unit's own label is: neither left out nor lone
    [[nodiscard]] Label label(std::int64_t unit, UnitObjects::Mark mark) const {
        return first_[static_cast<std::size_t>(unit)] + mark;
    }
    /// All objects by the merger's label, of which 0 is none. Call once: they are forgotten.
    [[nodiscard]] std::vector<SeamObject> take();

  private:
    /// What lies at the seams of a unit, until it has been compared.
    struct Unit {
        std::vector<SeenObject> objects;
        std::vector<SeamObject> places;  ///< of these
        UnitEdges edges;
    };
    void compare_next();

    std::int32_t cols_;
    std::vector<Unit> units_;
    std::vector<bool> known_;   ///< by unit
    std::vector<Label> first_;  ///< by unit: what was added to the places of its objects at the seams
    std::size_t next_ = 0;      ///< unit that is to be compared
    std::vector<SeamObject> seen_{{}};
    UnitMerger merger_;
    UnitSeams seams_;
};

}  // namespace d2b

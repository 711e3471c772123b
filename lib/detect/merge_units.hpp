#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "detect/detection.hpp"
#include "detect/label_sets.hpp"

namespace d2b {

/// An object as one unit of a window saw it.
struct SeenObject {
    DetectedObject object;
    bool is_building = false;
    double ground = 0;           ///< elevation, m; NaN where it is not known
    std::int64_t own_cells = 0;  ///< of its cells, those that are the unit's own
};

/// Objects of a window that was looked at in units which overlap. Each unit sees more cells than are its own,
/// so that two units see the same things on both sides of the seam between them: what covers the same cells
/// there is one object, and the unit that owns more of it says what it is; of those that own as much the
/// first.
class UnitMerger {
  public:
    /// @param objects of the next unit, by label - 1 @return what to add to its labels other than 0
    Label add(std::span<const SeenObject> objects);
    /// A line of cells beside a seam, as the units on both sides saw it, with labels that have been added to.
    void compare(std::span<const Label> first, std::span<const Label> second);

    struct Merged {
        std::vector<SeenObject> objects;  ///< buildings first, then what is doubtful
        Label buildings = 0;
        std::vector<Label> number;  ///< place in `objects` plus one, by label that was added to; 0: left out
    };
    /// @param least_cells objects with fewer are left out: slivers on the far side of a seam
    [[nodiscard]] Merged finish(std::int64_t least_cells);

  private:
    LabelSets sets_;
    std::vector<SeenObject> seen_{1};  ///< by label
};

}  // namespace d2b

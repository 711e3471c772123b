#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <unordered_map>
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
/// first. Objects that a unit divided one into belong together, and so do those that other units saw of them.
class UnitMerger {
  public:
    /// @param objects of the next unit, by label - 1 @return what to add to its labels other than 0
    Label add(std::span<const SeenObject> objects);
    /// A line of cells beside a seam, as the units on both sides saw it, with labels that have been added to.
    void compare(std::span<const Label> first, std::span<const Label> second);

    struct Merged {
        /// Buildings first, then what is doubtful. DetectedObject::whole is the lowest number of those that
        /// belong together.
        std::vector<SeenObject> objects;
        Label buildings = 0;
        std::vector<Label> number;  ///< place in `objects` plus one, by label that was added to; 0: left out
    };
    /// Call once: what was seen is forgotten.
    /// @param least_cells objects with fewer are left out: slivers on the far side of a seam
    [[nodiscard]] Merged finish(std::int64_t least_cells);

  private:
    /// What several units saw of one object.
    struct Joined {
        Label says = 0;  ///< what it is
        std::int64_t cells = 0;
    };
    /// Of the sets with more than one label, by the label that stands for each: few objects lie at a seam.
    [[nodiscard]] std::unordered_map<Label, Joined> joined_sets();

    /// @param objects that finish() gives, with their numbers by label that was added to
    void name_wholes(const std::vector<Label>& number, std::vector<SeenObject>& objects);

    LabelSets sets_;
    LabelSets wholes_;                ///< of labels that belong together
    std::deque<SeenObject> seen_{1};  ///< by label; there may be very many
};

}  // namespace d2b

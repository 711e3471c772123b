#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <unordered_map>
#include <vector>

#include "detect/detection.hpp"
#include "detect/label_sets.hpp"

namespace d2b {

/// Object as detected in one unit of a window.
struct SeenObject {
    DetectedObject object;
    bool is_building = false;
    double ground = 0;           ///< elevation in m; NaN if unknown
    std::int64_t own_cells = 0;  ///< its cells within the core of the unit
};

/// Merges the objects of overlapping units. The extent of a unit exceeds its core, so that two units detect
/// the same objects on both sides of their seam: objects that cover the same cells there are one object, and
/// the unit with most of it in its core provides its attributes (the first unit in case of a tie). Objects
/// that a unit divided from one whole belong together, and so do their counterparts in other units.
class UnitMerger {
  public:
    /// Adds the objects of the next unit.
    /// @param objects objects by label - 1
    /// @return offset for its labels other than 0
    Label add(std::span<const SeenObject> objects);
    /// Compares a line of cells next to a seam, as labelled by the units on both sides. Labels include the
    /// offsets of the units.
    void compare(std::span<const Label> first, std::span<const Label> second);

    struct Merged {
        /// Buildings first, then doubtful objects. DetectedObject::whole is the lowest number of those that
        /// belong together.
        std::vector<SeenObject> objects;
        Label buildings = 0;
        std::vector<Label> number;  ///< index in `objects` plus one, by label with offset; 0: dropped
    };
    /// Call once: clears the objects.
    /// @param least_cells smaller objects are dropped: slivers on the far side of a seam
    [[nodiscard]] Merged finish(std::int64_t least_cells);

  private:
    /// Object detected by several units.
    struct Joined {
        Label says = 0;  ///< label that provides its attributes
        std::int64_t cells = 0;
    };
    /// Returns the sets with more than one label, by their representative. They are few, because few objects
    /// touch a seam.
    [[nodiscard]] std::unordered_map<Label, Joined> joined_sets();

    /// @param number numbers by label with offset
    /// @param objects result of finish()
    void name_wholes(const std::vector<Label>& number, std::vector<SeenObject>& objects);

    LabelSets sets_;
    LabelSets wholes_;                ///< sets of labels that belong together
    std::deque<SeenObject> seen_{1};  ///< by label; a deque, because there may be very many
};

}  // namespace d2b

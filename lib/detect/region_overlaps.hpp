#pragma once

#include <cstdint>
#include <vector>

#include "detect/regions.hpp"

namespace d2b {

/// Number of cells shared by a region of one set and a region of another set.
struct RegionOverlap {
    Label one = 0;
    Label other = 0;
    std::int64_t cells = 0;

    friend bool operator==(const RegionOverlap&, const RegionOverlap&) = default;
};

/// Returns all overlaps between two sets of regions on the same grid, sorted by the labels of the first set,
/// then the second.
[[nodiscard]] std::vector<RegionOverlap> region_overlaps(const Regions& one, const Regions& other);

/// Returns the label of `other` with most cells in each region of `one`; the lowest label in case of a tie, 0
/// if there is no overlap. [0] is 0.
[[nodiscard]] std::vector<Label> holders(const Regions& one, const Regions& other);

}  // namespace d2b

#pragma once

#include <cstdint>
#include <vector>

#include "detect/regions.hpp"

namespace d2b {

/// Cells that a region shares with one of another set.
struct RegionOverlap {
    Label one = 0;
    Label other = 0;
    std::int64_t cells = 0;

    friend bool operator==(const RegionOverlap&, const RegionOverlap&) = default;
};

/// Which regions of two sets on one grid share cells, by the labels of the first and then of the other set.
[[nodiscard]] std::vector<RegionOverlap> region_overlaps(const Regions& one, const Regions& other);

/// For each label of `one` the label of `other` that holds most of its cells, of several the lowest; 0 where
/// none holds any. [0] is 0.
[[nodiscard]] std::vector<Label> holders(const Regions& one, const Regions& other);

}  // namespace d2b

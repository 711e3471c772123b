#pragma once

#include <cstdint>
#include <vector>

#include "contours/contour.hpp"
#include "features/record_builder.hpp"

namespace d2b::features {

/// Label of a building with a footprint, and the whole that it is a part of.
struct PartOfWhole {
    std::int64_t whole = 0;  ///< as in Footprint
    Label label = 0;

    friend auto operator<=>(const PartOfWhole&, const PartOfWhole&) = default;
};

/// Returns the labels that have a footprint and belong to a whole, sorted, without repetition.
[[nodiscard]] std::vector<PartOfWhole> parts_of_wholes(const contours::ContourList& contours,
                                                       const std::vector<Footprint>& footprints);
/// Returns the wholes of which several labels are parts, in ascending order. @param parts without repetition
[[nodiscard]] std::vector<std::int64_t> divided_wholes(std::vector<PartOfWhole> parts);

}  // namespace d2b::features

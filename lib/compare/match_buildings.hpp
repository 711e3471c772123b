#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "compare/surveyed_building.hpp"

namespace d2b::compare {

/// Overlap of two buildings.
struct SharedArea {
    std::size_t old_index = 0;
    std::size_t new_index = 0;
    double of_old = 0;  ///< share of the old building's area
    double of_new = 0;  ///< share of the new building's area
};

/// All overlaps, by old building.
[[nodiscard]] std::vector<SharedArea> shared_areas(std::span<const Polygons> old_outlines,
                                                   std::span<const Polygons> new_outlines, Overlay& overlay);

/// Buildings of both surveys that are the same or parts of the same. One side is empty if nothing of the
/// other survey stands there.
struct MatchedBuildings {
    std::vector<std::size_t> old_indices;
    std::vector<std::size_t> new_indices;
};

/// Matches buildings that share at least half of the smaller one, and buildings that several of the other
/// survey cover by half. One survey may divide what the other joins, so a match may have several of each.
/// @return every building once: first those with a new building, by their first one, then the others
[[nodiscard]] std::vector<MatchedBuildings> match_buildings(std::size_t old_count, std::size_t new_count,
                                                            std::span<const SharedArea> shared);

}  // namespace d2b::compare

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dem2buildings_mesh/city_plan.hpp"
#include "dem2buildings_mesh/plan_frame.hpp"
#include "dem2buildings_mesh/plan_mesh.hpp"
#include "dem2buildings_mesh/shell.hpp"

namespace d2b::mesh {

/// Heights above a divided plan, in steps.
struct PlanHeights {
    std::vector<Region> regions;
    std::vector<std::int64_t> terrain;  ///< of each node; empty: no terrain, buildings stand on their bases
    std::int64_t plate = 0;             ///< below the terrain
    /// Regions and their heights at each node; empty if all roofs are level.
    std::vector<std::vector<std::pair<std::int32_t, std::int64_t>>> slanted = {};

    /// @param region next to the node
    [[nodiscard]] std::int64_t top(std::int32_t region, std::uint32_t node) const;
    /// Fills `slanted` from the planes of regions.
    void raise_roofs(const PlanMesh& mesh, const PlanFrame& frame);
};

/// Roofs, walls, and grounds, or terrain with sides and a plate, as one surface: where heights of neighbours
/// differ a wall stands, with a corner wherever something ends at one of its vertical edges.
/// @param max_edge of walls, metres; 0: no limit. Their vertical edges are divided, for both walls alike, in
/// rounds until no edge is longer @throws InputError a wall that the rounds do not do
[[nodiscard]] Shell stand_up(const PlanMesh& mesh, const PlanHeights& heights, const PlanFrame& frame,
                             double max_edge);

}  // namespace d2b::mesh

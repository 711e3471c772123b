// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "dem2buildings_mesh/stand_up.hpp"

namespace d2b::mesh {

/// A vertical quadrangle over an edge of the plan: seen from outside it rises between two columns, from left
/// to right. Heights at each end from the lower side to the higher one.
struct WallPanel {
    ShellPart part = ShellPart::wall;
    std::int32_t building = -1;
    std::uint32_t left_node = 0;
    std::uint32_t right_node = 0;
    std::int64_t left_low = 0;
    std::int64_t left_high = 0;
    std::int64_t right_low = 0;
    std::int64_t right_high = 0;
};

/// Panels where heights on both sides of an edge of the plan differ.
[[nodiscard]] std::vector<WallPanel> wall_panels(const PlanMesh& mesh, const PlanHeights& heights);

/// The corners of the vertical line over each node.
class Columns {
  public:
    /// All ends of panels at their nodes.
    Columns(std::size_t nodes, const std::vector<WallPanel>& panels);

    /// Heights at a node from one to another, both among them.
    [[nodiscard]] std::vector<std::int64_t> between(std::uint32_t node, std::int64_t low,
                                                    std::int64_t high) const;
    /// Divides all between the ends at a node in parts of a length at most.
    void divide(std::uint32_t node, std::int64_t most);

  private:
    std::vector<std::vector<std::int64_t>> heights_;  ///< ascending, distinct
    std::vector<std::vector<std::int64_t>> ends_;     ///< those that panels have
};

}  // namespace d2b::mesh

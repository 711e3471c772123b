// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/columns.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <tuple>

namespace d2b::mesh {
namespace {

/// An edge of a triangle, which lies on the left of the way from `from` to `to`.
struct Side {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::int32_t region = beyond;
};

/// One for each edge of the mesh at which regions meet, as the lower node sees it: left and right.
struct Border {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::int32_t left = beyond;
    std::int32_t right = beyond;
};

std::vector<Border> borders_of(const PlanMesh& mesh) {
    std::vector<Side> sides;
    for (const PlanTriangle& triangle : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i)
            sides.push_back({triangle.nodes[i], triangle.nodes[(i + 1) % 3], triangle.region});
    const auto key = [](const Side& side) {
        return std::tuple(std::min(side.from, side.to), std::max(side.from, side.to), side.from);
    };
    std::ranges::sort(sides, {}, key);
    std::vector<Border> borders;
    for (const Side& side : sides) {
        const auto [low, high, from] = key(side);
        if (borders.empty() || borders.back().low != low || borders.back().high != high)
            borders.push_back({low, high, beyond, beyond});
        (from == low ? borders.back().left : borders.back().right) = side.region;
    }
    std::erase_if(borders, [](const Border& border) { return border.left == border.right; });
    return borders;
}

class PanelMaker {
  public:
    explicit PanelMaker(const PlanHeights& heights) : heights_(heights) {}

    /// @param inside the side that is higher
    [[nodiscard]] WallPanel panel(std::uint32_t left_node, std::uint32_t right_node, std::int32_t inside,
                                  std::int32_t outside) const {
        WallPanel panel;
        panel.part = inside < 0 ? ShellPart::sides : ShellPart::wall;
        panel.building = inside < 0 ? -1 : heights_.regions[static_cast<std::size_t>(inside)].building;
        panel.left_node = left_node;
        panel.right_node = right_node;
        panel.left_low = height(outside, inside, left_node);
        panel.right_low = height(outside, inside, right_node);
        panel.left_high = height(inside, outside, left_node);
        panel.right_high = height(inside, outside, right_node);
        return panel;
    }
    /// Height of one side of an edge at a node. @param other region on the other side
    [[nodiscard]] std::int64_t height(std::int32_t region, std::int32_t other, std::uint32_t node) const {
        if (region >= 0)
            return heights_.top(region, node);
        if (heights_.terrain.empty())
            return heights_.regions[static_cast<std::size_t>(other)].base;
        return region == beyond ? heights_.plate : heights_.terrain[node];
    }

  private:
    const PlanHeights& heights_;
};

/// The heights at which panels end at each node, ascending.
std::vector<std::vector<std::int64_t>> ends_of(std::size_t nodes, const std::vector<WallPanel>& panels) {
    std::vector<std::vector<std::int64_t>> ends(nodes);
    for (const WallPanel& panel : panels) {
        for (const std::int64_t z : {panel.left_low, panel.left_high})
            ends[panel.left_node].push_back(z);
        for (const std::int64_t z : {panel.right_low, panel.right_high})
            ends[panel.right_node].push_back(z);
    }
    for (std::vector<std::int64_t>& column : ends) {
        std::ranges::sort(column);
        column.erase(std::unique(column.begin(), column.end()), column.end());
    }
    return ends;
}

}  // namespace

std::vector<WallPanel> wall_panels(const PlanMesh& mesh, const PlanHeights& heights) {
    const PanelMaker maker(heights);
    std::vector<WallPanel> panels;
    for (const Border& border : borders_of(mesh)) {
        const auto differ = [&](std::uint32_t node) {
            return maker.height(border.left, border.right, node) <=>
                   maker.height(border.right, border.left, node);
        };
        // Slanted roofs may meet at one end.
        const auto higher = differ(border.low) != 0 ? differ(border.low) : differ(border.high);
        if (higher > 0)
            panels.push_back(maker.panel(border.low, border.high, border.left, border.right));
        else if (higher < 0)
            panels.push_back(maker.panel(border.high, border.low, border.right, border.left));
    }
    return panels;
}

Columns::Columns(std::size_t nodes, const std::vector<WallPanel>& panels)
    : heights_(ends_of(nodes, panels)), ends_(heights_) {}

std::vector<std::int64_t> Columns::between(std::uint32_t node, std::int64_t low, std::int64_t high) const {
    const std::vector<std::int64_t>& column = heights_[node];
    return {std::ranges::lower_bound(column, low), std::ranges::upper_bound(column, high)};
}

void Columns::divide(std::uint32_t node, std::int64_t most) {
    const std::vector<std::int64_t>& ends = ends_[node];
    std::vector<std::int64_t> column;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const std::int64_t parts = (ends[i + 1] - ends[i] + most - 1) / most;
        for (std::int64_t part = 0; part < parts; ++part)
            column.push_back(ends[i] + (ends[i + 1] - ends[i]) * part / parts);
    }
    if (!ends.empty())
        column.push_back(ends.back());
    heights_[node] = std::move(column);
}

}  // namespace d2b::mesh

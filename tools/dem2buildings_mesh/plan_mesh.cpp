// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/plan_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace d2b::mesh {

double fewest_points(const PlanDrawing& drawing, double most) {
    const auto is_divided = [&](std::int32_t region) {
        return region >= 0 || (drawing.with_ground && region == surface::open_ground) ? 1 : 0;
    };
    double twice_area = 0;
    double length = 0;
    for (const surface::PartitionEdge& edge : drawing.edges) {
        const Position& a = drawing.nodes[edge.from];
        const Position& b = drawing.nodes[edge.to];
        twice_area += (a.x * b.y - a.y * b.x) * (is_divided(edge.left) - is_divided(edge.right));
        length += std::hypot(b.x - a.x, b.y - a.y);
    }
    // None is larger than that of three equal edges, and there are two of them a point.
    return std::max(twice_area / (most * most * std::numbers::sqrt3), length / most);
}

void split_long_edges(PlanDrawing& drawing, double most) {
    std::vector<surface::PartitionEdge> edges;
    for (const surface::PartitionEdge& edge : drawing.edges) {
        const Position a = drawing.nodes[edge.from];
        const Position b = drawing.nodes[edge.to];
        const int parts = static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y) / most));
        surface::PartitionEdge part = edge;
        for (int i = 1; i < parts; ++i) {
            const double share = static_cast<double>(i) / parts;
            part.to = static_cast<std::uint32_t>(drawing.nodes.size());
            drawing.nodes.push_back({a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share});
            edges.push_back(part);
            part.from = part.to;
        }
        part.to = edge.to;
        edges.push_back(part);
    }
    drawing.edges = std::move(edges);
}

CornerAngle smallest_angle(const std::array<Position, 3>& corners) {
    CornerAngle smallest;
    for (std::size_t i = 0; i < 3; ++i) {
        const Position& at = corners[i];
        const Position& b = corners[(i + 1) % 3];
        const Position& c = corners[(i + 2) % 3];
        const double cross = (b.x - at.x) * (c.y - at.y) - (b.y - at.y) * (c.x - at.x);
        const double dot = (b.x - at.x) * (c.x - at.x) + (b.y - at.y) * (c.y - at.y);
        const double degrees = std::atan2(std::abs(cross), dot) * 180 / std::numbers::pi;
        if (degrees < smallest.degrees)
            smallest = {degrees, i};
    }
    return smallest;
}

}  // namespace d2b::mesh

#include "surface/triangulate.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "dem2buildings/error.hpp"
#include "outline/fine_geometry.hpp"
#include "surface/divide_face.hpp"

namespace d2b {
namespace {

using Way = std::pair<std::uint32_t, std::uint32_t>;

void add_ways(std::span<const std::uint32_t> ring, std::vector<Way>& ways) {
    for (std::size_t i = 0; i < ring.size(); ++i)
        ways.emplace_back(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]);
}

/// Returns the directed edges of the face.
std::vector<Way> border_of(const PlanFace& face) {
    std::vector<Way> ways;
    add_ways(face.exterior, ways);
    for (const auto& ring : face.interiors)
        add_ways(ring, ways);
    std::ranges::sort(ways);
    return ways;
}

/// Returns the directed edges whose reverse is not an edge of any triangle.
std::vector<Way> border_of(const std::vector<PlanTriangle>& triangles) {
    std::vector<Way> ways;
    for (const PlanTriangle& triangle : triangles)
        add_ways(triangle, ways);
    std::ranges::sort(ways);
    std::vector<Way> border;
    std::ranges::copy_if(ways, std::back_inserter(border), [&](const Way& way) {
        return !std::ranges::binary_search(ways, Way(way.second, way.first));
    });
    return border;
}

/// Looks up nodes of a face by position.
class NodesByPlace {
  public:
    NodesByPlace(const PlanFace& face, const Plan& plan) {
        for (const auto& [from, to] : border_of(face))
            nodes_.emplace_back(plan.nodes[from], from);
        std::ranges::sort(nodes_);
    }
    [[nodiscard]] std::optional<std::uint32_t> at(FinePoint point) const {
        const auto found =
            std::ranges::lower_bound(nodes_, point, {}, &std::pair<FinePoint, std::uint32_t>::first);
        if (found == nodes_.end() || found->first != point)
            return std::nullopt;
        return found->second;
    }

  private:
    std::vector<std::pair<FinePoint, std::uint32_t>> nodes_;
};

/// @return nothing if a vertex is not a node of the face, or a triangle is degenerate
std::optional<std::vector<PlanTriangle>> on_nodes(const std::vector<FineTriangle>& triangles,
                                                  const NodesByPlace& nodes) {
    std::vector<PlanTriangle> result;
    for (const FineTriangle& triangle : triangles) {
        const int turns = side(triangle[0], triangle[1], triangle[2]);
        PlanTriangle& made = result.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            const auto node = nodes.at(triangle[i]);
            if (!node || turns == 0)
                return std::nullopt;
            made[turns > 0 ? i : 2 - i] = *node;
        }
    }
    return result;
}

FinePoint exchanged(FinePoint point) {
    return {point.col, point.row};
}

/// Mirrors and reverses, so that exteriors stay counter-clockwise.
FinePolygon exchanged(FinePolygon polygon) {
    const auto exchange = [](FineRing& ring) {
        std::ranges::reverse(ring);
        std::ranges::transform(ring, ring.begin(), [](FinePoint p) { return exchanged(p); });
    };
    exchange(polygon.exterior);
    std::ranges::for_each(polygon.interiors, exchange);
    return polygon;
}

std::vector<FineTriangle> exchanged(std::vector<FineTriangle> triangles) {
    for (FineTriangle& triangle : triangles)
        std::ranges::transform(triangle, triangle.begin(), [](FinePoint p) { return exchanged(p); });
    return triangles;
}

/// Tries the polygon as it is, then mirrored.
std::optional<std::vector<PlanTriangle>> in_one_piece(const PlanFace& face, const Plan& plan,
                                                      const Triangulate& triangulate) {
    const FinePolygon polygon = polygon_of(face, plan);
    const NodesByPlace nodes(face, plan);
    const std::vector<Way> border = border_of(face);
    for (const bool turned : {false, true}) {
        std::vector<FineTriangle> found;
        try {
            found = turned ? exchanged(triangulate(exchanged(polygon))) : triangulate(polygon);
        } catch (const GeometryError&) {
            continue;
        }
        auto triangles = on_nodes(found, nodes);
        if (triangles && border_of(*triangles) == border)
            return triangles;
    }
    return std::nullopt;
}

}  // namespace

std::optional<std::vector<PlanTriangle>> triangulate_face(const PlanFace& face, const Plan& plan,
                                                          const Triangulate& triangulate) {
    if (auto triangles = in_one_piece(face, plan, triangulate))
        return triangles;
    std::vector<PlanTriangle> all;
    for (const PlanFace& piece : divide_face(face, plan)) {
        const auto triangles = in_one_piece(piece, plan, triangulate);
        if (!triangles)
            return std::nullopt;
        all.insert(all.end(), triangles->begin(), triangles->end());
    }
    return all;
}

}  // namespace d2b

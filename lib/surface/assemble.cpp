#include "surface/assemble.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

namespace d2b {
namespace {

/// Collects the vertices and buildings of a part.
class PartBuilder {
  public:
    PartBuilder(const Plan& plan, std::span<const std::int64_t> ids)
        : plan_(plan), ids_(ids), corners_(plan.nodes.size()) {}

    /// Returns the index of a vertex, which is added on first use.
    [[nodiscard]] std::uint32_t corner(std::uint32_t node, std::int64_t z) {
        auto& known = corners_[node];
        const auto found = std::ranges::find(known, z, &std::pair<std::int64_t, std::uint32_t>::first);
        if (found != known.end())
            return found->second;
        const auto number = static_cast<std::uint32_t>(part_.points.size());
        part_.points.push_back({plan_.nodes[node].col, -plan_.nodes[node].row, z});
        known.emplace_back(z, number);
        return number;
    }
    [[nodiscard]] SurfaceBuilding& building(std::int32_t place) {
        const auto [found, is_new] = places_.try_emplace(place, part_.buildings.size());
        if (is_new)
            part_.buildings.emplace_back().id = ids_[static_cast<std::size_t>(place)];
        return part_.buildings[found->second];
    }
    [[nodiscard]] SurfacePart take() {
        std::ranges::sort(part_.buildings, {}, &SurfaceBuilding::id);
        return std::move(part_);
    }

  private:
    const Plan& plan_;
    std::span<const std::int64_t> ids_;
    std::vector<std::vector<std::pair<std::int64_t, std::uint32_t>>> corners_;  // per node: height and vertex
    std::map<std::int32_t, std::size_t> places_;  // building -> position in the part
    SurfacePart part_;
};

/// Returns a horizontal face. Seen from below (ground), its rings are reversed.
SurfaceFace level_face(const LevelFace& level, FaceKind kind, PartBuilder& builder) {
    const auto ring_of = [&](const std::vector<std::uint32_t>& nodes) {
        std::vector<std::uint32_t> ring;
        ring.reserve(nodes.size());
        for (const std::uint32_t node : nodes)
            ring.push_back(builder.corner(node, level.z));
        if (kind == FaceKind::ground)
            std::ranges::reverse(ring);
        return ring;
    };
    SurfaceFace face{kind, ring_of(level.face.exterior), {}};
    for (const auto& nodes : level.face.interiors)
        face.interiors.push_back(ring_of(nodes));
    return face;
}

/// Returns vertices in ascending order.
std::vector<std::uint32_t> column(std::uint32_t node, const std::vector<std::int64_t>& heights,
                                  PartBuilder& builder) {
    std::vector<std::uint32_t> corners;
    corners.reserve(heights.size());
    for (const std::int64_t z : heights)
        corners.push_back(builder.corner(node, z));
    return corners;
}

SurfaceFace wall_face(const WallFace& wall, PartBuilder& builder) {
    const std::vector<std::uint32_t> left = column(wall.left_node, wall.left, builder);
    SurfaceFace face{FaceKind::wall, column(wall.right_node, wall.right, builder), {}};
    face.exterior.insert(face.exterior.begin(), left.front());
    face.exterior.insert(face.exterior.end(), left.rbegin(), left.rend() - 1);
    return face;
}

/// Triangulates a wall: the lower of the next vertices on both sides completes the next triangle.
void add_wall(const WallFace& wall, PartBuilder& builder) {
    const std::vector<std::uint32_t> left = column(wall.left_node, wall.left, builder);
    const std::vector<std::uint32_t> right = column(wall.right_node, wall.right, builder);
    auto& triangles = builder.building(wall.building).triangles;
    for (std::size_t l = 0, r = 0; l + 1 < left.size() || r + 1 < right.size();) {
        const bool on_right =
            l + 1 == left.size() || (r + 1 < right.size() && wall.right[r + 1] <= wall.left[l + 1]);
        const std::uint32_t next = on_right ? right[r + 1] : left[l + 1];
        triangles.push_back({FaceKind::wall, {left[l], right[r], next}});
        ++(on_right ? r : l);
    }
}

/// Caches triangulations, because the roof and the ground of a building are often the same face.
class FaceTriangles {
  public:
    FaceTriangles(const Plan& plan, const Triangulate& triangulate)
        : plan_(plan), triangulate_(triangulate) {}

    [[nodiscard]] const std::optional<std::vector<PlanTriangle>>& of(const PlanFace& face) {
        const auto [found, is_new] = known_.try_emplace(face);
        if (is_new)
            found->second = triangulate_face(face, plan_, triangulate_);
        return found->second;
    }

  private:
    const Plan& plan_;
    const Triangulate& triangulate_;
    std::map<PlanFace, std::optional<std::vector<PlanTriangle>>> known_;
};

void add_level(const LevelFace& level, FaceKind kind, const std::vector<PlanTriangle>& triangles,
               PartBuilder& builder) {
    for (PlanTriangle triangle : triangles) {
        if (kind == FaceKind::ground)
            std::swap(triangle[1], triangle[2]);
        SurfaceTriangle made{kind, {}};
        std::ranges::transform(triangle, made.corners.begin(),
                               [&](std::uint32_t node) { return builder.corner(node, level.z); });
        builder.building(level.building).triangles.push_back(made);
    }
}

}  // namespace

SurfacePart assemble_faces(const Extrusion& extrusion, const Plan& plan, std::span<const std::int64_t> ids) {
    PartBuilder builder(plan, ids);
    for (const LevelFace& level : extrusion.roofs)
        builder.building(level.building).faces.push_back(level_face(level, FaceKind::roof, builder));
    for (const WallFace& wall : extrusion.walls)
        builder.building(wall.building).faces.push_back(wall_face(wall, builder));
    for (const LevelFace& level : extrusion.grounds)
        builder.building(level.building).faces.push_back(level_face(level, FaceKind::ground, builder));
    return builder.take();
}

AssembledTriangles assemble_triangles(const Extrusion& extrusion, const Plan& plan,
                                      std::span<const std::int64_t> ids, const Triangulate& triangulate) {
    PartBuilder builder(plan, ids);
    FaceTriangles faces(plan, triangulate);
    AssembledTriangles result;
    const auto add = [&](const LevelFace& level, FaceKind kind) {
        if (const auto& triangles = faces.of(level.face))
            add_level(level, kind, *triangles, builder);
        else
            result.failed.push_back(level.building);
    };
    for (const LevelFace& level : extrusion.roofs)
        add(level, FaceKind::roof);
    for (const WallFace& wall : extrusion.walls)
        add_wall(wall, builder);
    for (const LevelFace& level : extrusion.grounds)
        add(level, FaceKind::ground);
    std::ranges::sort(result.failed);
    result.part = builder.take();
    return result;
}

}  // namespace d2b

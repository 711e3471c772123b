#include "surface/make_surfaces.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "core/for_rings.hpp"
#include "surface/partition.hpp"
#include "surface/roof_heights.hpp"
#include "surface/vertex_snapping.hpp"

namespace d2b::surface {

/// Input of an extrusion: each contour of a plan extends from the base to its roof.
struct ExtrusionInput {
    PlanarPartition plan;                    ///< contains only these contours; everything else is outside
    const RoofHeights& roofs;                ///< above the base wherever a contour has an edge
    std::span<const std::int32_t> building;  ///< by contour
    std::int64_t base = 0;

    /// @param contour next to the node
    [[nodiscard]] std::int64_t height(std::int32_t contour, std::uint32_t node) const {
        return contour == open_ground ? base : roofs.at(contour, plan.nodes[node]);
    }
};

/// Face that is not a wall.
struct CoverFace {
    std::int32_t building = 0;
    std::int32_t contour = open_ground;  ///< open_ground: the ground of the building
    PartitionFace face;
};

/// Wall above an edge. Seen from outside, it extends between two vertical lines of vertices, left and right.
struct WallFace {
    std::int32_t building = 0;  ///< the higher building
    std::uint32_t left_node = 0;
    std::uint32_t right_node = 0;
    std::vector<std::int64_t> left;   ///< ascending heights; one if the roofs meet there
    std::vector<std::int64_t> right;  ///< ascending heights; at least two on one side
};

/// Surface of the extruded plan. It is closed, because a wall has a vertex at every height at which a roof
/// next to one of its vertical edges ends.
struct Extrusion {
    std::vector<CoverFace> roofs;
    std::vector<CoverFace> grounds;  ///< one outline per building, as seen from above
    std::vector<WallFace> walls;     ///< sorted like the edges
};

/// Surface of triangles, or the buildings with a face that could not be triangulated.
struct AssembledTriangles {
    SurfacePart part;
    std::vector<std::int32_t> failed;  ///< ascending; if not empty, the part is unusable
};
namespace {

class Extruder {
  public:
    explicit Extruder(const ExtrusionInput& standing) : standing_(standing) {}

    [[nodiscard]] Extrusion make() {
        Extrusion result;
        add_roofs(result);
        add_grounds(result);
        find_heights();
        for (const PartitionEdge& edge : standing_.plan.edges)
            add_wall(edge, result);
        return result;
    }

  private:
    [[nodiscard]] std::int32_t building(std::int32_t contour) const {
        return contour == open_ground ? open_ground : standing_.building[static_cast<std::size_t>(contour)];
    }
    void add_roofs(Extrusion& result) const;
    void add_grounds(Extrusion& result) const;
    void find_heights();
    [[nodiscard]] std::vector<std::int64_t> column(std::uint32_t node, std::int64_t low,
                                                   std::int64_t high) const;
    void add_wall(const PartitionEdge& edge, Extrusion& result) const;

    const ExtrusionInput& standing_;
    std::vector<std::vector<std::int64_t>> heights_;  // heights around each node, ascending
};

void Extruder::add_roofs(Extrusion& result) const {
    for (OwnedFace& owned : partition_faces(standing_.plan))
        result.roofs.push_back({building(owned.owner), owned.owner, std::move(owned.face)});
}

/// Adds the ground of each building as a whole, whatever stands on it.
void Extruder::add_grounds(Extrusion& result) const {
    PlanarPartition plan{standing_.plan.nodes, {}};
    for (const PartitionEdge& edge : standing_.plan.edges)
        if (const PartitionEdge low{edge.from, edge.to, building(edge.left), building(edge.right)};
            low.left != low.right)
            plan.edges.push_back(low);
    straighten(plan, Straighten::inside);
    for (OwnedFace& owned : partition_faces(plan))
        result.grounds.push_back({owned.owner, open_ground, std::move(owned.face)});
}

void Extruder::find_heights() {
    heights_.resize(standing_.plan.nodes.size());
    for (const PartitionEdge& edge : standing_.plan.edges)
        for (const std::uint32_t node : {edge.from, edge.to})
            for (const std::int32_t contour : {edge.left, edge.right})
                heights_[node].push_back(standing_.height(contour, node));
    for (std::vector<std::int64_t>& heights : heights_) {
        std::ranges::sort(heights);
        heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
    }
}

std::vector<std::int64_t> Extruder::column(std::uint32_t node, std::int64_t low, std::int64_t high) const {
    const std::vector<std::int64_t>& all = heights_[node];
    return {std::ranges::lower_bound(all, low), std::ranges::upper_bound(all, high)};
}

/// Adds the wall between the roofs on both sides of an edge, of which one is higher at one end at least.
void Extruder::add_wall(const PartitionEdge& edge, Extrusion& result) const {
    const std::int64_t left_from = standing_.height(edge.left, edge.from);
    const std::int64_t right_from = standing_.height(edge.right, edge.from);
    const std::int64_t left_to = standing_.height(edge.left, edge.to);
    const std::int64_t right_to = standing_.height(edge.right, edge.to);
    if (left_from == right_from && left_to == right_to)
        return;
    const bool left_is_higher = left_from > right_from || left_to > right_to;
    std::vector<std::int64_t> from =
        column(edge.from, std::min(left_from, right_from), std::max(left_from, right_from));
    std::vector<std::int64_t> to = column(edge.to, std::min(left_to, right_to), std::max(left_to, right_to));
    // Seen from the lower side.
    if (left_is_higher)
        result.walls.push_back({building(edge.left), edge.from, edge.to, std::move(from), std::move(to)});
    else
        result.walls.push_back({building(edge.right), edge.to, edge.from, std::move(to), std::move(from)});
}

/// Collects the vertices and buildings of a part.
class PartBuilder {
  public:
    PartBuilder(const PlanarPartition& plan, std::span<const std::int64_t> ids)
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
    const PlanarPartition& plan_;
    std::span<const std::int64_t> ids_;
    std::vector<std::vector<std::pair<std::int64_t, std::uint32_t>>> corners_;  // per node: height and vertex
    std::map<std::int32_t, std::size_t> places_;  // building -> position in the part
    SurfacePart part_;
};

/// Returns a roof or a ground. Seen from below (ground), its rings are reversed.
SurfaceFace cover_face(const CoverFace& cover, FaceKind kind, const ExtrusionInput& standing,
                       PartBuilder& builder) {
    const auto ring_of = [&](const std::vector<std::uint32_t>& nodes) {
        std::vector<std::uint32_t> ring;
        ring.reserve(nodes.size());
        for (const std::uint32_t node : nodes)
            ring.push_back(builder.corner(node, standing.height(cover.contour, node)));
        if (kind == FaceKind::ground)
            std::ranges::reverse(ring);
        return ring;
    };
    SurfaceFace face{kind, ring_of(cover.face.exterior), {}, cover.contour};
    for (const auto& nodes : cover.face.interiors)
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
    FaceTriangles(const PlanarPartition& plan, const Triangulate& triangulate)
        : plan_(plan), triangulate_(triangulate) {}

    [[nodiscard]] const std::optional<std::vector<PartitionTriangle>>& of(const PartitionFace& face) {
        const auto [found, is_new] = known_.try_emplace(face);
        if (is_new)
            found->second = triangulate_face(face, plan_, triangulate_);
        return found->second;
    }

  private:
    const PlanarPartition& plan_;
    const Triangulate& triangulate_;
    std::map<PartitionFace, std::optional<std::vector<PartitionTriangle>>> known_;
};

void add_cover(const CoverFace& cover, FaceKind kind, const std::vector<PartitionTriangle>& triangles,
               const ExtrusionInput& standing, PartBuilder& builder) {
    for (PartitionTriangle triangle : triangles) {
        if (kind == FaceKind::ground)
            std::swap(triangle[1], triangle[2]);
        SurfaceTriangle made{kind, {}};
        std::ranges::transform(triangle, made.corners.begin(), [&](std::uint32_t node) {
            return builder.corner(node, standing.height(cover.contour, node));
        });
        builder.building(cover.building).triangles.push_back(made);
    }
}

/// Builds a surface of polygons. @param ids of the buildings, by index
SurfacePart assemble_faces(const Extrusion& extrusion, const ExtrusionInput& standing,
                           std::span<const std::int64_t> ids) {
    PartBuilder builder(standing.plan, ids);
    for (const CoverFace& roof : extrusion.roofs)
        builder.building(roof.building).faces.push_back(cover_face(roof, FaceKind::roof, standing, builder));
    for (const WallFace& wall : extrusion.walls)
        builder.building(wall.building).faces.push_back(wall_face(wall, builder));
    for (const CoverFace& ground : extrusion.grounds)
        builder.building(ground.building)
            .faces.push_back(cover_face(ground, FaceKind::ground, standing, builder));
    return builder.take();
}

AssembledTriangles assemble_triangles(const Extrusion& extrusion, const ExtrusionInput& standing,
                                      std::span<const std::int64_t> ids, const Triangulate& triangulate) {
    PartBuilder builder(standing.plan, ids);
    FaceTriangles faces(standing.plan, triangulate);
    AssembledTriangles result;
    const auto add = [&](const CoverFace& cover, FaceKind kind) {
        if (const auto& triangles = faces.of(cover.face))
            add_cover(cover, kind, *triangles, standing, builder);
        else
            result.failed.push_back(cover.building);
    };
    for (const CoverFace& roof : extrusion.roofs)
        add(roof, FaceKind::roof);
    for (const WallFace& wall : extrusion.walls)
        add_wall(wall, builder);
    for (const CoverFace& ground : extrusion.grounds)
        add(ground, FaceKind::ground);
    std::ranges::sort(result.failed);
    result.part = builder.take();
    return result;
}

using Places = std::vector<std::int32_t>;  ///< indices of buildings

/// Returns true if each edge is traversed once in each direction. With slanted roofs that depends on heights
/// that have been rounded.
bool is_closed(const SurfacePart& part) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    const auto add = [&](std::span<const std::uint32_t> ring) {
        for (std::size_t i = 0; i < ring.size(); ++i)
            edges.emplace_back(ring[i], ring[i + 1 < ring.size() ? i + 1 : 0]);
    };
    for (const SurfaceBuilding& building : part.buildings) {
        for (const SurfaceFace& face : building.faces)
            for_rings(face, add);
        for (const SurfaceTriangle& triangle : building.triangles)
            add(triangle.corners);
    }
    std::ranges::sort(edges);
    return std::ranges::adjacent_find(edges) == edges.end() &&
           std::ranges::all_of(edges, [&](const auto& edge) {
               return std::ranges::binary_search(edges, std::pair(edge.second, edge.first));
           });
}

/// Contours of the buildings that have not been excluded.
class IncludedContours {
  public:
    IncludedContours(const SurfaceCluster& cluster, const std::vector<bool>& is_out) {
        std::vector<std::int32_t> place(cluster.contours.size(), open_ground);
        for (std::size_t i = 0; i < cluster.contours.size(); ++i) {
            const PartitionContour& contour = cluster.contours[i];
            if (is_out[static_cast<std::size_t>(contour.building)])
                continue;
            place[i] = static_cast<std::int32_t>(contours_.size());
            contours_.push_back(contour);
            numbers_.push_back(static_cast<std::int32_t>(i));
            if (contour.parent >= 0)
                contours_.back().parent = place[static_cast<std::size_t>(contour.parent)];
        }
    }
    [[nodiscard]] std::span<const PartitionContour> contours() const { return contours_; }
    [[nodiscard]] std::vector<PartitionContour>& contours() { return contours_; }
    [[nodiscard]] std::int32_t building(std::int32_t contour) const {
        return contours_[static_cast<std::size_t>(contour)].building;
    }
    /// Returns the contour's index in the cluster.
    [[nodiscard]] std::int32_t number(std::int32_t contour) const {
        return numbers_[static_cast<std::size_t>(contour)];
    }

  private:
    std::vector<PartitionContour> contours_;
    std::vector<std::int32_t> numbers_;
};

/// Surfaces of the chosen buildings, or the buildings to exclude.
struct Attempt {
    MadeSurfaces made;
    Places obstructing;
};

class SurfaceMaker {
  public:
    SurfaceMaker(const SurfaceCluster& cluster, const std::vector<bool>& is_out, const SurfaceForms& forms,
                 const Triangulate& triangulate, const StopToken& stop)
        : cluster_(cluster),
          included_(cluster, is_out),
          forms_(forms),
          triangulate_(triangulate),
          stop_(stop) {
        for (const ClusterBuilding& building : cluster.buildings)
            ids_.push_back(building.id);
        for (const PartitionContour& contour : included_.contours())
            building_of_.push_back(contour.building);
    }

    [[nodiscard]] Attempt make();

  private:
    using Edges = std::vector<std::uint32_t>;
    [[nodiscard]] bool draw_plan();
    [[nodiscard]] bool raise_roofs();
    [[nodiscard]] bool is_slanted(std::int32_t contour) const {
        return included_.contours()[static_cast<std::size_t>(contour)].plane.has_value();
    }
    [[nodiscard]] std::int64_t base(std::int32_t contour) const {
        return cluster_.buildings[static_cast<std::size_t>(included_.building(contour))].base;
    }
    void remove_flat_contours();
    [[nodiscard]] std::vector<std::uint32_t> blocks() const;
    [[nodiscard]] std::vector<Edges> edges_by(const std::vector<std::uint32_t>& group) const;
    [[nodiscard]] ExtrusionInput standing(const Edges& edges, const std::vector<std::uint32_t>& group,
                                          std::uint32_t which) const;
    [[nodiscard]] std::optional<std::vector<PartitionTriangle>> divide_twisted(
        const CoverFace& roof, const ExtrusionInput& standing) const;
    void divide_twisted_roofs(Extrusion& extrusion, const ExtrusionInput& standing) const;
    void make_solids();
    void make_shell();

    const SurfaceCluster& cluster_;
    IncludedContours included_;
    SurfaceForms forms_;
    const Triangulate& triangulate_;
    const StopToken& stop_;
    std::vector<std::int64_t> ids_;
    RoofHeights roofs_;
    Places building_of_;  // by contour
    PlanarPartition plan_;
    std::vector<FinePoint> crossings_;  // nodes at which roofs cross each other
    Attempt attempt_;
};

/// Removes contours whose level roofs are not above the base of their building.
void SurfaceMaker::remove_flat_contours() {
    const auto is_flat = [&](std::int32_t contour) {
        if (contour == open_ground || is_slanted(contour))
            return false;
        const auto c = static_cast<std::size_t>(contour);
        return !forms_.gaps.rises_above(included_.contours()[c].top,
                                        cluster_.buildings[static_cast<std::size_t>(building_of_[c])].base);
    };
    for (PartitionEdge& edge : plan_.edges) {
        edge.left = is_flat(edge.left) ? open_ground : edge.left;
        edge.right = is_flat(edge.right) ? open_ground : edge.right;
    }
    std::erase_if(plan_.edges, [](const PartitionEdge& edge) { return edge.left == edge.right; });
}

/// @return true if the plan is usable
bool SurfaceMaker::draw_plan() {
    PartitionResult partition = make_partition(included_.contours(), stop_);
    for (const std::uint32_t contour : partition.conflicting)
        attempt_.obstructing.push_back(included_.building(static_cast<std::int32_t>(contour)));
    if (!attempt_.obstructing.empty())
        return false;
    plan_ = std::move(partition.plan);
    remove_flat_contours();
    merge_near_nodes(plan_, forms_.gaps.corners);
    level_near_roofs(plan_, included_.contours(), forms_.gaps.heights);
    ResolvedVertices taken =
        resolve_nonmanifold_vertices(plan_, included_.contours(), {forms_.move_steps, forms_.gaps}, stop_);
    if (!taken.unresolved.empty()) {
        attempt_.obstructing.push_back(
            included_.building(static_cast<std::int32_t>(taken.unresolved.back())));
        return false;
    }
    for (VertexRepair& mend : taken.repairs)
        for (std::int32_t& contour : mend.contours)
            contour = included_.number(contour);
    attempt_.made.repairs = std::move(taken.repairs);
    return raise_roofs();
}

/// Sets the heights of roofs. @return false if roofs cross along an edge, are not plane, or are not above
/// their base
bool SurfaceMaker::raise_roofs() {
    crossings_ = split_crossings(plan_, included_.contours());
    roofs_ = RoofHeights(plan_, included_.contours());
    for (const std::int32_t contour : roofs_.join_near_crossings(plan_))
        attempt_.obstructing.push_back(included_.building(contour));
    for (const std::int32_t contour : roofs_.uneven_roofs(included_.contours()))
        attempt_.obstructing.push_back(included_.building(contour));
    for (const PartitionEdge& edge : plan_.edges)
        for (const std::int32_t contour : {edge.left, edge.right})
            if (contour != open_ground && is_slanted(contour))
                for (const std::uint32_t node : {edge.from, edge.to})
                    if (!forms_.gaps.rises_above(roofs_.at(contour, plan_.nodes[node]), base(contour)))
                        attempt_.obstructing.push_back(included_.building(contour));
    return attempt_.obstructing.empty();
}

/// Returns a number per building that is equal for buildings with common walls.
std::vector<std::uint32_t> SurfaceMaker::blocks() const {
    DisjointSets sets(static_cast<std::uint32_t>(cluster_.buildings.size()));
    for (const PartitionEdge& edge : plan_.edges)
        if (edge.left != open_ground && edge.right != open_ground)
            sets.join(static_cast<std::uint32_t>(included_.building(edge.left)),
                      static_cast<std::uint32_t>(included_.building(edge.right)));
    std::vector<std::uint32_t> block(cluster_.buildings.size());
    for (std::uint32_t i = 0; i < block.size(); ++i)
        block[i] = sets.find(i);
    return block;
}

/// Returns the edges that bound each group. @param group by building
std::vector<SurfaceMaker::Edges> SurfaceMaker::edges_by(const std::vector<std::uint32_t>& group) const {
    std::vector<Edges> edges(cluster_.buildings.size());
    const auto group_of = [&](std::int32_t contour) {
        return group[static_cast<std::size_t>(included_.building(contour))];
    };
    for (std::uint32_t e = 0; e < plan_.edges.size(); ++e) {
        const PartitionEdge& edge = plan_.edges[e];
        if (edge.left != open_ground)
            edges[group_of(edge.left)].push_back(e);
        if (edge.right != open_ground &&
            (edge.left == open_ground || group_of(edge.left) != group_of(edge.right)))
            edges[group_of(edge.right)].push_back(e);
    }
    return edges;
}

ExtrusionInput SurfaceMaker::standing(const Edges& edges, const std::vector<std::uint32_t>& group,
                                      std::uint32_t which) const {
    ExtrusionInput result{extract_partition(
                              plan_, edges,
                              [&](std::int32_t contour) {
                                  return group[static_cast<std::size_t>(included_.building(contour))] ==
                                         which;
                              },
                              crossings_),
                          roofs_, building_of_, std::numeric_limits<std::int64_t>::max()};
    for (const PartitionEdge& edge : result.plan.edges)
        for (const std::int32_t contour : {edge.left, edge.right})
            if (contour != open_ground)
                result.base = std::min(result.base, base(contour));
    return result;
}

/// Divides a slanted roof into triangles where programs would refuse the polygon as not planar (val3dity if a
/// triangle turns 20 degrees away from it): half a step of height is enough if corners are nearly on a line.
/// @return nullopt for other roofs
std::optional<std::vector<PartitionTriangle>> SurfaceMaker::divide_twisted(
    const CoverFace& roof, const ExtrusionInput& standing) const {
    if (!is_slanted(roof.contour))
        return std::nullopt;
    auto triangles = triangulate_face(roof.face, standing.plan, triangulate_);
    const auto corner = [&](std::uint32_t node) {
        const FinePoint at = standing.plan.nodes[node];
        return RoofCorner{static_cast<double>(at.row), static_cast<double>(at.col),
                          static_cast<double>(standing.height(roof.contour, node))};
    };
    const RoofPlane& plane = *included_.contours()[static_cast<std::size_t>(roof.contour)].plane;
    return triangles && is_twisted(plane, roof.face, *triangles, corner) ? std::move(triangles)
                                                                         : std::nullopt;
}

void SurfaceMaker::divide_twisted_roofs(Extrusion& extrusion, const ExtrusionInput& standing) const {
    std::vector<CoverFace> roofs;
    for (CoverFace& roof : extrusion.roofs)
        if (const auto triangles = divide_twisted(roof, standing))
            for (const PartitionTriangle& triangle : *triangles)
                roofs.push_back({roof.building, roof.contour, {{triangle.begin(), triangle.end()}, {}}});
        else
            roofs.push_back(std::move(roof));
    extrusion.roofs = std::move(roofs);
}

void SurfaceMaker::make_solids() {
    std::vector<std::uint32_t> each(cluster_.buildings.size());
    for (std::uint32_t i = 0; i < each.size(); ++i)
        each[i] = i;
    const std::vector<Edges> edges = edges_by(each);
    for (std::uint32_t i = 0; i < each.size(); ++i) {
        if (edges[i].empty())
            continue;
        stop_.check();
        const ExtrusionInput alone = standing(edges[i], each, i);
        Extrusion extrusion = Extruder(alone).make();
        if (roofs_.are_slanted())
            divide_twisted_roofs(extrusion, alone);
        SurfacePart& part = attempt_.made.solids.emplace_back(assemble_faces(extrusion, alone, ids_));
        for (SurfaceFace& face : part.buildings.front().faces)
            if (face.roof >= 0)
                face.roof = is_slanted(face.roof) ? included_.number(face.roof) : -1;
        if (roofs_.are_slanted() && !is_closed(part))
            attempt_.obstructing.push_back(static_cast<std::int32_t>(i));
    }
}

void SurfaceMaker::make_shell() {
    const std::vector<std::uint32_t> block = blocks();
    const std::vector<Edges> edges = edges_by(block);
    for (std::uint32_t i = 0; i < block.size(); ++i) {
        if (edges[i].empty())
            continue;
        stop_.check();
        const ExtrusionInput together = standing(edges[i], block, i);
        AssembledTriangles made = assemble_triangles(Extruder(together).make(), together, ids_, triangulate_);
        attempt_.obstructing.insert(attempt_.obstructing.end(), made.failed.begin(), made.failed.end());
        if (roofs_.are_slanted() && made.failed.empty() && !is_closed(made.part))
            for (std::uint32_t building = 0; building < block.size(); ++building)
                if (block[building] == i)
                    attempt_.obstructing.push_back(static_cast<std::int32_t>(building));
        attempt_.made.shell.push_back(std::move(made.part));
    }
}

Attempt SurfaceMaker::make() {
    if (!draw_plan())
        return std::move(attempt_);
    if (forms_.shell)
        make_shell();
    if (forms_.solids && attempt_.obstructing.empty())
        make_solids();
    return std::move(attempt_);
}

}  // namespace

MadeSurfaces make_surfaces(const SurfaceCluster& cluster, const SurfaceForms& forms,
                           const Triangulate& triangulate, const StopToken& stop) {
    std::vector<bool> is_out(cluster.buildings.size());
    std::vector<std::int64_t> left_out;
    while (true) {
        Attempt attempt = SurfaceMaker(cluster, is_out, forms, triangulate, stop).make();
        if (attempt.obstructing.empty()) {
            attempt.made.left_out = std::move(left_out);
            return std::move(attempt.made);
        }
        for (const std::int32_t building : attempt.obstructing) {
            if (is_out[static_cast<std::size_t>(building)])
                continue;
            is_out[static_cast<std::size_t>(building)] = true;
            left_out.push_back(cluster.buildings[static_cast<std::size_t>(building)].id);
        }
        std::ranges::sort(left_out);
    }
}

}  // namespace d2b::surface

#include "surface/faces.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <span>
#include <unordered_map>
#include <utility>

#include "core/for_rings.hpp"
#include "dem2buildings/error.hpp"
#include "outline/fine_geometry.hpp"

namespace d2b::surface {
namespace {

using Ring = std::vector<std::uint32_t>;

constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

struct OwnedRing {
    std::int32_t owner = open_ground;
    Ring ring;
    Int128 twice_area = 0;
};

Int128 twice_area(const Ring& ring, const PlanarPartition& plan) {
    Int128 sum = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        sum += outline::turn(plan.nodes[ring[0]], plan.nodes[ring[i]], plan.nodes[ring[i + 1]]);
    return sum;
}

/// Traverses each half-edge once, turning at every node so that the face stays on the left.
class FaceTracer {
  public:
    explicit FaceTracer(const PlanarPartition& plan)
        : plan_(plan),
          around_(edges_around_nodes(plan)),
          done_(plan.edges.size()),
          place_(plan.nodes.size(), nowhere) {}

    [[nodiscard]] std::vector<OwnedRing> rings() {
        for (std::uint32_t e = 0; e < plan_.edges.size(); ++e)
            for (const bool forwards : {true, false}) {
                const PartitionEdge& edge = plan_.edges[e];
                const std::int32_t owner = forwards ? edge.left : edge.right;
                if (owner != open_ground && !done_[e][forwards ? 1 : 0])
                    split(walk(e, forwards), owner);
            }
        return std::move(rings_);
    }

  private:
    Ring walk(std::uint32_t e, bool forwards);
    void split(const Ring& walked, std::int32_t owner);

    const PlanarPartition& plan_;
    std::vector<std::vector<IncidentEdge>> around_;
    std::vector<std::array<bool, 2>> done_;
    std::vector<std::size_t> place_;  // position of a node in the current ring
    std::vector<OwnedRing> rings_;
};

Ring FaceTracer::walk(std::uint32_t e, bool forwards) {
    Ring ring;
    while (!done_[e][forwards ? 1 : 0]) {
        done_[e][forwards ? 1 : 0] = true;
        const PartitionEdge& edge = plan_.edges[e];
        ring.push_back(forwards ? edge.from : edge.to);
        const std::uint32_t node = forwards ? edge.to : edge.from;
        // The next half-edge is the clockwise neighbour of the one arrived on, because the face is on the
        // left.
        const std::vector<IncidentEdge>& arms = around_[node];
        const auto here = std::ranges::find(arms, e, &IncidentEdge::edge);
        const IncidentEdge& next = here == arms.begin() ? arms.back() : *(here - 1);
        e = next.edge;
        forwards = plan_.edges[e].from == node;
    }
    return ring;
}

/// Splits a ring at repeated nodes.
void FaceTracer::split(const Ring& walked, std::int32_t owner) {
    Ring open;
    for (const std::uint32_t node : walked) {
        if (const std::size_t again = place_[node]; again != nowhere) {
            const auto first = open.begin() + static_cast<std::ptrdiff_t>(again);
            OwnedRing loop{owner, Ring(first, open.end()), 0};
            loop.twice_area = twice_area(loop.ring, plan_);
            for (const std::uint32_t gone : loop.ring)
                place_[gone] = nowhere;
            rings_.push_back(std::move(loop));
            open.erase(first, open.end());
        }
        place_[node] = open.size();
        open.push_back(node);
    }
    for (const std::uint32_t node : open)
        place_[node] = nowhere;
    const Int128 area = twice_area(open, plan_);
    rings_.push_back({owner, std::move(open), area});
}

/// Finds the exterior ring that contains a hole, using only the edges in its band of rows, because testing
/// all edges would cost the length of a large face per hole.
class HoleLocator {
  public:
    HoleLocator(std::span<const OwnedRing> exteriors, const PlanarPartition& plan)
        : exteriors_(exteriors), plan_(plan) {
        for (std::size_t r = 0; r < exteriors.size(); ++r) {
            FinePoint from = plan.nodes[exteriors[r].ring.back()];
            for (const std::uint32_t node : exteriors[r].ring) {
                const FinePoint to = plan.nodes[node];
                const auto [low, high] = std::minmax(from.row, to.row);
                for (std::int64_t band = band_of(low); low != high && band <= band_of(high); ++band)
                    bands_[band].push_back({r, from, to});
                from = to;
            }
        }
    }
    /// Returns the index of the smallest containing exterior. Exact, in half steps. @param hole must not
    /// cross other rings
    [[nodiscard]] std::size_t of(const OwnedRing& hole) const {
        const FinePoint a = plan_.nodes[hole.ring[0]];
        const FinePoint b = plan_.nodes[hole.ring[1]];
        const FinePoint middle{a.row + b.row, a.col + b.col};
        std::map<std::size_t, bool> is_in;
        if (const auto edges = bands_.find(band_of(middle.row >> 1)); edges != bands_.end())
            for (const RingEdge& edge : edges->second) {
                const FinePoint from{2 * edge.from.row, 2 * edge.from.col};
                const FinePoint to{2 * edge.to.row, 2 * edge.to.col};
                if ((from.row > middle.row) != (to.row > middle.row) &&
                    (outline::side(from, to, middle) > 0) == (from.row < to.row))
                    is_in[edge.ring] = !is_in[edge.ring];
            }
        std::size_t holder = exteriors_.size();
        for (const auto& [ring, in] : is_in)
            if (in &&
                (holder == exteriors_.size() || exteriors_[ring].twice_area < exteriors_[holder].twice_area))
                holder = ring;
        return holder;
    }

  private:
    struct RingEdge {
        std::size_t ring = 0;
        FinePoint from;
        FinePoint to;
    };
    [[nodiscard]] static std::int64_t band_of(std::int64_t row) { return row >> 11; }

    std::span<const OwnedRing> exteriors_;
    const PlanarPartition& plan_;
    std::unordered_map<std::int64_t, std::vector<RingEdge>> bands_;
};

/// @param rings of one owner
void add_faces(std::span<OwnedRing> rings, const PlanarPartition& plan, std::vector<OwnedFace>& faces) {
    // Iterators, because Clang 14 does not compile the range version.
    const auto first_hole = std::stable_partition(rings.begin(), rings.end(),
                                                  [](const OwnedRing& r) { return r.twice_area > 0; });
    const auto exteriors = rings.first(static_cast<std::size_t>(first_hole - rings.begin()));
    const auto holes = rings.subspan(exteriors.size());
    const std::size_t first = faces.size();
    for (const OwnedRing& ring : exteriors)
        faces.push_back({ring.owner, {ring.ring, {}}});
    if (holes.empty())
        return;
    std::optional<HoleLocator> holders;
    if (exteriors.size() > 1)
        holders.emplace(exteriors, plan);
    for (OwnedRing& hole : holes) {
        const std::size_t holder = holders ? holders->of(hole) : 0;
        faces[first + holder].face.interiors.push_back(std::move(hole.ring));
    }
}

/// Node with its neighbours on a ring; the interior of the face is on the left.
struct RingCorner {
    std::uint32_t before = 0;
    std::uint32_t node = 0;
    std::uint32_t after = 0;
};

/// Downward edge on the sweep line that has the face to its east.
struct OpenEdge {
    std::uint32_t top = 0;
    std::uint32_t bottom = 0;
    std::uint32_t helper = 0;  // lowest node so far between this edge and the next one to the east
    bool merges = false;       // the helper is a merge vertex
};

/// Face with renumbered nodes, sorted from north to south, then from west to east.
struct LocalFace {
    PlanarPartition plan;
    std::vector<std::uint32_t> nodes;  // node numbers of the original plan
    std::vector<RingCorner> corners;   // ascending nodes
};

LocalFace local_face(const PartitionFace& face, const PlanarPartition& plan) {
    LocalFace local;
    std::vector<std::span<const std::uint32_t>> rings{face.exterior};
    rings.insert(rings.end(), face.interiors.begin(), face.interiors.end());
    for (const auto& ring : rings)
        local.nodes.insert(local.nodes.end(), ring.begin(), ring.end());
    std::ranges::sort(local.nodes, {}, [&](std::uint32_t node) { return plan.nodes[node]; });
    for (const std::uint32_t node : local.nodes)
        local.plan.nodes.push_back(plan.nodes[node]);
    const auto place = [&](std::uint32_t node) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(local.plan.nodes, plan.nodes[node]) -
                                          local.plan.nodes.begin());
    };
    for (const auto& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const std::uint32_t from = place(ring[i]);
            const std::uint32_t to = place(ring[(i + 1) % ring.size()]);
            local.plan.edges.push_back({from, to, 0, open_ground});
            local.corners.push_back({place(ring[(i + ring.size() - 1) % ring.size()]), from, to});
        }
    std::ranges::sort(local.corners, {}, &RingCorner::node);
    return local;
}

class FaceSweep {
  public:
    explicit FaceSweep(LocalFace& face) : face_(face) {}

    /// Adds the diagonals to the face's plan.
    void run() {
        for (const RingCorner& corner : face_.corners)
            visit(corner);
    }

  private:
    using Open = std::vector<OpenEdge>::iterator;

    void visit(const RingCorner& corner);
    void visit_lowest(const RingCorner& corner, bool merges);
    void visit_highest(const RingCorner& corner, bool splits);
    /// Returns the first edge that is not west of a node.
    [[nodiscard]] Open east_of(std::uint32_t node) {
        const std::vector<FinePoint>& points = face_.plan.nodes;
        return std::ranges::partition_point(open_, [&](const OpenEdge& edge) {
            return outline::side(points[edge.top], points[edge.bottom], points[node]) > 0;
        });
    }
    [[nodiscard]] Open ending_at(std::uint32_t node) {
        return std::ranges::find(open_, node, &OpenEdge::bottom);
    }
    void join(std::uint32_t a, std::uint32_t b) { face_.plan.edges.push_back({a, b, 0, 0}); }
    void connect_to_merge_helper(const OpenEdge& edge, std::uint32_t node) {
        if (edge.merges)
            join(edge.helper, node);
    }
    void help(OpenEdge& edge, std::uint32_t node, bool merges) {
        connect_to_merge_helper(edge, node);
        edge.helper = node;
        edge.merges = merges;
    }

    LocalFace& face_;
    std::vector<OpenEdge> open_;  // from west to east
};

/// Start or split vertex: both neighbours are below.
void FaceSweep::visit_highest(const RingCorner& corner, bool splits) {
    const auto east = east_of(corner.node);
    if (splits) {
        OpenEdge& west = *(east - 1);
        join(west.helper, corner.node);
        west.helper = corner.node;
        west.merges = false;
    }
    open_.insert(east, {corner.node, corner.after, corner.node, false});
}

/// End or merge vertex: both neighbours are above.
void FaceSweep::visit_lowest(const RingCorner& corner, bool merges) {
    const auto ended = ending_at(corner.node);
    connect_to_merge_helper(*ended, corner.node);
    const auto east = open_.erase(ended);
    if (merges)
        help(*(east - 1), corner.node, true);
}

void FaceSweep::visit(const RingCorner& corner) {
    const bool comes_from_above = corner.before < corner.node;
    const bool goes_down = corner.after > corner.node;
    const std::vector<FinePoint>& points = face_.plan.nodes;
    const bool reflex = outline::side(points[corner.before], points[corner.node], points[corner.after]) < 0;
    if (!comes_from_above && goes_down) {
        visit_highest(corner, reflex);
    } else if (comes_from_above && !goes_down) {
        visit_lowest(corner, reflex);
    } else if (comes_from_above) {
        OpenEdge& edge = *ending_at(corner.node);
        connect_to_merge_helper(edge, corner.node);
        edge = {corner.node, corner.after, corner.node, false};
    } else {
        help(*(east_of(corner.node) - 1), corner.node, false);
    }
}

using Way = std::pair<std::uint32_t, std::uint32_t>;

void add_ways(std::span<const std::uint32_t> ring, std::vector<Way>& ways) {
    for (std::size_t i = 0; i < ring.size(); ++i)
        ways.emplace_back(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]);
}

/// Returns the directed edges of the face.
std::vector<Way> border_of(const PartitionFace& face) {
    std::vector<Way> ways;
    for_rings(face, [&](const Ring& ring) { add_ways(ring, ways); });
    std::ranges::sort(ways);
    return ways;
}

/// Returns the directed edges whose reverse is not an edge of any triangle.
std::vector<Way> border_of(const std::vector<PartitionTriangle>& triangles) {
    std::vector<Way> ways;
    for (const PartitionTriangle& triangle : triangles)
        add_ways(triangle, ways);
    std::ranges::sort(ways);
    std::vector<Way> border;
    std::ranges::copy_if(ways, std::back_inserter(border), [&](const Way& way) {
        return !std::ranges::binary_search(ways, Way(way.second, way.first));
    });
    return border;
}

/// Looks up nodes of a face by position.
class NodeLookup {
  public:
    NodeLookup(const PartitionFace& face, const PlanarPartition& plan) {
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
std::optional<std::vector<PartitionTriangle>> to_node_triangles(const std::vector<FineTriangle>& triangles,
                                                                const NodeLookup& nodes) {
    std::vector<PartitionTriangle> result;
    for (const FineTriangle& triangle : triangles) {
        const int turns = outline::side(triangle[0], triangle[1], triangle[2]);
        PartitionTriangle& made = result.emplace_back();
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
    for_rings(polygon, exchange);
    return polygon;
}

std::vector<FineTriangle> exchanged(std::vector<FineTriangle> triangles) {
    for (FineTriangle& triangle : triangles)
        std::ranges::transform(triangle, triangle.begin(), [](FinePoint p) { return exchanged(p); });
    return triangles;
}

/// Tries the polygon as it is, then mirrored.
std::optional<std::vector<PartitionTriangle>> triangulate_whole(const PartitionFace& face,
                                                                const PlanarPartition& plan,
                                                                const Triangulate& triangulate) {
    const FinePolygon polygon = polygon_of(face, plan);
    const NodeLookup nodes(face, plan);
    const std::vector<Way> border = border_of(face);
    for (const bool turned : {false, true}) {
        std::vector<FineTriangle> found;
        try {
            found = turned ? exchanged(triangulate(exchanged(polygon))) : triangulate(polygon);
        } catch (const GeometryError&) {
            continue;
        }
        auto triangles = to_node_triangles(found, nodes);
        if (triangles && border_of(*triangles) == border)
            return triangles;
    }
    return std::nullopt;
}

}  // namespace

std::vector<OwnedFace> partition_faces(const PlanarPartition& plan) {
    std::vector<OwnedRing> rings = FaceTracer(plan).rings();
    std::ranges::stable_sort(rings, {}, &OwnedRing::owner);
    std::vector<OwnedFace> faces;
    for (auto begin = rings.begin(); begin != rings.end();) {
        const auto end = std::find_if(begin, rings.end(),
                                      [&](const OwnedRing& ring) { return ring.owner != begin->owner; });
        add_faces(std::span(begin, end), plan, faces);
        begin = end;
    }
    return faces;
}

FinePolygon polygon_of(const PartitionFace& face, const PlanarPartition& plan) {
    const auto ring_of = [&](const Ring& ring) {
        FineRing points;
        for (const std::uint32_t node : ring)
            points.push_back(plan.nodes[node]);
        return points;
    };
    FinePolygon polygon{ring_of(face.exterior), {}};
    for (const Ring& ring : face.interiors)
        polygon.interiors.push_back(ring_of(ring));
    return polygon;
}

std::vector<PartitionFace> split_into_monotone(const PartitionFace& face, const PlanarPartition& plan) {
    LocalFace local = local_face(face, plan);
    FaceSweep(local).run();
    std::vector<PartitionFace> pieces;
    for (OwnedFace& piece : partition_faces(local.plan)) {
        for (std::uint32_t& node : piece.face.exterior)
            node = local.nodes[node];
        pieces.push_back(std::move(piece.face));
    }
    return pieces;
}

std::optional<std::vector<PartitionTriangle>> triangulate_face(const PartitionFace& face,
                                                               const PlanarPartition& plan,
                                                               const Triangulate& triangulate) {
    if (auto triangles = triangulate_whole(face, plan, triangulate))
        return triangles;
    std::vector<PartitionTriangle> all;
    for (const PartitionFace& piece : split_into_monotone(face, plan)) {
        const auto triangles = triangulate_whole(piece, plan, triangulate);
        if (!triangles)
            return std::nullopt;
        all.insert(all.end(), triangles->begin(), triangles->end());
    }
    return all;
}

}  // namespace d2b::surface

#include "surface/divide_face.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "outline/fine_geometry.hpp"

namespace d2b {
namespace {

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
    Plan plan;
    std::vector<std::uint32_t> nodes;  // node numbers of the original plan
    std::vector<RingCorner> corners;   // ascending nodes
};

LocalFace local_face(const PlanFace& face, const Plan& plan) {
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
            return side(points[edge.top], points[edge.bottom], points[node]) > 0;
        });
    }
    [[nodiscard]] Open ending_at(std::uint32_t node) {
        return std::ranges::find(open_, node, &OpenEdge::bottom);
    }
    void join(std::uint32_t a, std::uint32_t b) { face_.plan.edges.push_back({a, b, 0, 0}); }
    void join_where_it_merges(const OpenEdge& edge, std::uint32_t node) {
        if (edge.merges)
            join(edge.helper, node);
    }
    void help(OpenEdge& edge, std::uint32_t node, bool merges) {
        join_where_it_merges(edge, node);
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
    join_where_it_merges(*ended, corner.node);
    const auto east = open_.erase(ended);
    if (merges)
        help(*(east - 1), corner.node, true);
}

void FaceSweep::visit(const RingCorner& corner) {
    const bool comes_from_above = corner.before < corner.node;
    const bool goes_down = corner.after > corner.node;
    const std::vector<FinePoint>& points = face_.plan.nodes;
    const bool reflex = side(points[corner.before], points[corner.node], points[corner.after]) < 0;
    if (!comes_from_above && goes_down) {
        visit_highest(corner, reflex);
    } else if (comes_from_above && !goes_down) {
        visit_lowest(corner, reflex);
    } else if (comes_from_above) {
        OpenEdge& edge = *ending_at(corner.node);
        join_where_it_merges(edge, corner.node);
        edge = {corner.node, corner.after, corner.node, false};
    } else {
        help(*(east_of(corner.node) - 1), corner.node, false);
    }
}

}  // namespace

std::vector<PlanFace> divide_face(const PlanFace& face, const Plan& plan) {
    LocalFace local = local_face(face, plan);
    FaceSweep(local).run();
    std::vector<PlanFace> pieces;
    for (OwnedFace& piece : plan_faces(local.plan)) {
        for (std::uint32_t& node : piece.face.exterior)
            node = local.nodes[node];
        pieces.push_back(std::move(piece.face));
    }
    return pieces;
}

}  // namespace d2b

#include "surface/plan_faces.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "outline/fine_geometry.hpp"
#include "surface/node_star.hpp"

namespace d2b {
namespace {

using Ring = std::vector<std::uint32_t>;

struct OwnedRing {
    std::int32_t owner = open_ground;
    Ring ring;
    Int128 twice_area = 0;
};

Int128 twice_area(const Ring& ring, const Plan& plan) {
    Int128 sum = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        sum += turn(plan.nodes[ring[0]], plan.nodes[ring[i]], plan.nodes[ring[i + 1]]);
    return sum;
}

/// Each directed edge once, with the area on its left kept on the left at every node.
class RingWalker {
  public:
    explicit RingWalker(const Plan& plan) : plan_(plan), stars_(plan), done_(plan.edges.size()) {}

    [[nodiscard]] std::vector<OwnedRing> rings() {
        for (std::uint32_t e = 0; e < plan_.edges.size(); ++e)
            for (const bool forwards : {true, false}) {
                const PlanEdge& edge = plan_.edges[e];
                const std::int32_t owner = forwards ? edge.left : edge.right;
                if (owner != open_ground && !done_[e][forwards ? 1 : 0])
                    split(walk(e, forwards), owner);
            }
        return std::move(rings_);
    }

  private:
    Ring walk(std::uint32_t e, bool forwards);
    void split(const Ring& walked, std::int32_t owner);

    const Plan& plan_;
    NodeStars stars_;
    std::vector<std::array<bool, 2>> done_;
    std::vector<OwnedRing> rings_;
};

Ring RingWalker::walk(std::uint32_t e, bool forwards) {
    Ring ring;
    while (!done_[e][forwards ? 1 : 0]) {
        done_[e][forwards ? 1 : 0] = true;
        const PlanEdge& edge = plan_.edges[e];
        ring.push_back(forwards ? edge.from : edge.to);
        const std::uint32_t node = forwards ? edge.to : edge.from;
        // Of the sector on the left, the arm on the other side: the one before, counter-clockwise.
        const std::vector<NodeArm>& arms = stars_.around(node);
        const auto here = std::ranges::find(arms, e, &NodeArm::edge);
        const NodeArm& next = here == arms.begin() ? arms.back() : *(here - 1);
        e = next.edge;
        forwards = plan_.edges[e].from == node;
    }
    return ring;
}

/// A ring that comes through a node again is several.
void RingWalker::split(const Ring& walked, std::int32_t owner) {
    Ring open;
    for (const std::uint32_t node : walked) {
        if (const auto again = std::ranges::find(open, node); again != open.end()) {
            OwnedRing loop{owner, Ring(again, open.end()), 0};
            loop.twice_area = twice_area(loop.ring, plan_);
            rings_.push_back(std::move(loop));
            open.erase(again, open.end());
        }
        open.push_back(node);
    }
    const Int128 area = twice_area(open, plan_);
    rings_.push_back({owner, std::move(open), area});
}

/// Whether the middle of an edge lies in a ring that does not run through it. Exact, on halves of steps.
bool holds_middle(const Ring& ring, FinePoint a, FinePoint b, const Plan& plan) {
    const FinePoint middle{a.row + b.row, a.col + b.col};
    bool in = false;
    FinePoint from = plan.nodes[ring.back()];
    from = {2 * from.row, 2 * from.col};
    for (const std::uint32_t node : ring) {
        const FinePoint to{2 * plan.nodes[node].row, 2 * plan.nodes[node].col};
        if ((from.row > middle.row) != (to.row > middle.row)) {
            const bool down = from.row < to.row;
            if ((side(from, to, middle) > 0) == down)
                in = !in;
        }
        from = to;
    }
    return in;
}

/// The place of the smallest exterior ring that holds an interior one. @param exteriors at least one
std::size_t holder_of(const OwnedRing& hole, std::span<const OwnedRing> exteriors, const Plan& plan) {
    std::size_t holder = exteriors.size();
    for (std::size_t i = 0; i < exteriors.size(); ++i)
        if ((holder == exteriors.size() || exteriors[i].twice_area < exteriors[holder].twice_area) &&
            holds_middle(exteriors[i].ring, plan.nodes[hole.ring[0]], plan.nodes[hole.ring[1]], plan))
            holder = i;
    return holder;
}

/// @param rings of one owner
void add_faces(std::span<OwnedRing> rings, const Plan& plan, std::vector<OwnedFace>& faces) {
    // By iterators: of a range Clang 14 cannot compile it.
    const auto first_hole = std::stable_partition(rings.begin(), rings.end(),
                                                  [](const OwnedRing& r) { return r.twice_area > 0; });
    const auto exteriors = rings.first(static_cast<std::size_t>(first_hole - rings.begin()));
    const auto holes = rings.subspan(exteriors.size());
    const std::size_t first = faces.size();
    for (const OwnedRing& ring : exteriors)
        faces.push_back({ring.owner, {ring.ring, {}}});
    for (OwnedRing& hole : holes) {
        const std::size_t holder = exteriors.size() == 1 ? 0 : holder_of(hole, exteriors, plan);
        faces[first + holder].face.interiors.push_back(std::move(hole.ring));
    }
}

}  // namespace

std::vector<OwnedFace> plan_faces(const Plan& plan) {
    std::vector<OwnedRing> rings = RingWalker(plan).rings();
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

FinePolygon polygon_of(const PlanFace& face, const Plan& plan) {
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

}  // namespace d2b

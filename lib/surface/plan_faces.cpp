#include "surface/plan_faces.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

#include "outline/fine_geometry.hpp"
#include "surface/node_star.hpp"

namespace d2b {
namespace {

using Ring = std::vector<std::uint32_t>;

constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

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

/// Traverses each half-edge once, turning at every node so that the face stays on the left.
class RingWalker {
  public:
    explicit RingWalker(const Plan& plan)
        : plan_(plan), stars_(plan), done_(plan.edges.size()), place_(plan.nodes.size(), nowhere) {}

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
    std::vector<std::size_t> place_;  // position of a node in the current ring
    std::vector<OwnedRing> rings_;
};

Ring RingWalker::walk(std::uint32_t e, bool forwards) {
    Ring ring;
    while (!done_[e][forwards ? 1 : 0]) {
        done_[e][forwards ? 1 : 0] = true;
        const PlanEdge& edge = plan_.edges[e];
        ring.push_back(forwards ? edge.from : edge.to);
        const std::uint32_t node = forwards ? edge.to : edge.from;
        // The next half-edge is the clockwise neighbour of the one arrived on, because the face is on the
        // left.
        const std::vector<NodeArm>& arms = stars_.around(node);
        const auto here = std::ranges::find(arms, e, &NodeArm::edge);
        const NodeArm& next = here == arms.begin() ? arms.back() : *(here - 1);
        e = next.edge;
        forwards = plan_.edges[e].from == node;
    }
    return ring;
}

/// Splits a ring at repeated nodes.
void RingWalker::split(const Ring& walked, std::int32_t owner) {
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
class HoleHolders {
  public:
    HoleHolders(std::span<const OwnedRing> exteriors, const Plan& plan) : exteriors_(exteriors), plan_(plan) {
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
                    (side(from, to, middle) > 0) == (from.row < to.row))
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
    const Plan& plan_;
    std::unordered_map<std::int64_t, std::vector<RingEdge>> bands_;
};

/// @param rings of one owner
void add_faces(std::span<OwnedRing> rings, const Plan& plan, std::vector<OwnedFace>& faces) {
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
    std::optional<HoleHolders> holders;
    if (exteriors.size() > 1)
        holders.emplace(exteriors, plan);
    for (OwnedRing& hole : holes) {
        const std::size_t holder = holders ? holders->of(hole) : 0;
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

#include "surface/planar_partition.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "outline/fine_geometry.hpp"

namespace d2b::surface {

LatticeDistance lattice_distance(double metres, const CellSize& cell) {
    // The distance from the box's side to its centre is the height of the parallelogram.
    const auto steps = [&](double side) {
        return std::max(std::int64_t{1},
                        static_cast<std::int64_t>(std::ceil(metres / (side * cell.sine) * FinePoint::steps)));
    };
    return {steps(cell.down), steps(cell.across)};
}

GapTolerances gap_tolerances(const CellSize& cell) {
    return {componentwise_max(lattice_distance(GapTolerances::pinch_m, cell), GapTolerances{}.pinch),
            lattice_distance(GapTolerances::corner_m, cell), 2};
}

void sort_around(const std::vector<FinePoint>& nodes, std::uint32_t node, std::vector<IncidentEdge>& arms) {
    const FinePoint from = nodes[node];
    std::ranges::sort(arms, [&](const IncidentEdge& a, const IncidentEdge& b) {
        return outline::precedes_ccw(from, nodes[a.end], nodes[b.end]);
    });
}

std::vector<std::vector<IncidentEdge>> edges_around_nodes(const PlanarPartition& plan) {
    std::vector<std::vector<IncidentEdge>> around(plan.nodes.size());
    for (std::uint32_t e = 0; e < plan.edges.size(); ++e)
        for (const std::uint32_t node : {plan.edges[e].from, plan.edges[e].to})
            around[node].push_back(seen_from(node, e, plan.edges[e]));
    for (std::uint32_t node = 0; node < around.size(); ++node)
        sort_around(plan.nodes, node, around[node]);
    return around;
}

PlanarPartition plan_of(std::vector<PartitionEdge> edges, const std::vector<FinePoint>& nodes) {
    std::vector<std::uint32_t> used;
    used.reserve(2 * edges.size());
    for (const PartitionEdge& edge : edges)
        used.insert(used.end(), {edge.from, edge.to});
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    PlanarPartition plan{{}, std::move(edges)};
    plan.nodes.reserve(used.size());
    for (const std::uint32_t node : used)
        plan.nodes.push_back(nodes[node]);
    for (PartitionEdge& edge : plan.edges)
        for (std::uint32_t* node : {&edge.from, &edge.to})
            *node = static_cast<std::uint32_t>(std::ranges::lower_bound(used, *node) - used.begin());
    return plan;
}

bool is_on(std::int32_t contour, std::int32_t below, std::span<const PartitionContour> contours) {
    while (contour != open_ground && contour != below)
        contour = contours[static_cast<std::size_t>(contour)].parent;
    return contour == below;
}

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Degree of a node and its first two edges.
struct Ends {
    std::uint32_t count = 0;
    std::array<std::uint32_t, 2> edges{none, none};
};

class Straightener {
  public:
    Straightener(PlanarPartition& plan, std::span<const FinePoint> kept)
        : plan_(plan), kept_(kept), ends_(plan.nodes.size()), gone_(plan.edges.size()) {
        for (std::uint32_t e = 0; e < plan.edges.size(); ++e)
            for (const std::uint32_t node : {plan.edges[e].from, plan.edges[e].to}) {
                Ends& ends = ends_[node];
                if (ends.count < ends.edges.size())
                    ends.edges[ends.count] = e;
                ++ends.count;
            }
    }

    void run(Straighten what) {
        for (std::uint32_t node = 0; node < ends_.size(); ++node)
            if (ends_[node].count == 2 && goes_straight_on(node, what) &&
                !std::ranges::binary_search(kept_, plan_.nodes[node]))
                join(node);
        std::size_t next = 0;
        std::erase_if(plan_.edges, [&](const PartitionEdge&) { return gone_[next++]; });
    }

  private:
    [[nodiscard]] std::uint32_t other_end(std::uint32_t e, std::uint32_t node) const {
        const PartitionEdge& edge = plan_.edges[e];
        return edge.from == node ? edge.to : edge.from;
    }
    [[nodiscard]] bool goes_straight_on(std::uint32_t node, Straighten what) const {
        const auto [a, b] = ends_[node].edges;
        const PartitionEdge& edge = plan_.edges[a];
        if (what == Straighten::inside && (edge.left == open_ground || edge.right == open_ground))
            return false;
        return outline::side(plan_.nodes[other_end(a, node)], plan_.nodes[node],
                             plan_.nodes[other_end(b, node)]) == 0;
    }
    void join(std::uint32_t node) {
        const auto [stays, goes] = ends_[node].edges;
        const std::uint32_t far = other_end(goes, node);
        PartitionEdge& edge = plan_.edges[stays];
        (edge.from == node ? edge.from : edge.to) = far;
        for (std::uint32_t& e : ends_[far].edges)
            if (e == goes)
                e = stays;
        gone_[goes] = true;
        ends_[node].count = 0;
    }

    PlanarPartition& plan_;
    std::span<const FinePoint> kept_;
    std::vector<Ends> ends_;
    std::vector<bool> gone_;
};

}  // namespace

void straighten(PlanarPartition& plan, Straighten what, std::span<const FinePoint> kept) {
    Straightener(plan, kept).run(what);
}

PlanarPartition extract_partition(const PlanarPartition& plan, std::span<const std::uint32_t> edges,
                                  const std::function<bool(std::int32_t)>& belongs,
                                  std::span<const FinePoint> kept) {
    std::vector<PartitionEdge> own;
    for (const std::uint32_t e : edges) {
        PartitionEdge edge = plan.edges[e];
        for (std::int32_t* contour : {&edge.left, &edge.right})
            if (*contour != open_ground && !belongs(*contour))
                *contour = open_ground;
        if (edge.left != edge.right)
            own.push_back(edge);
    }
    PlanarPartition part = plan_of(std::move(own), plan.nodes);
    straighten(part, Straighten::all, kept);
    return part;
}

}  // namespace d2b::surface

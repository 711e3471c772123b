#include "surface/node_star.hpp"

#include <algorithm>

#include "outline/fine_geometry.hpp"

namespace d2b {

void sort_around(const Plan& plan, std::uint32_t node, std::vector<NodeArm>& arms) {
    const FinePoint from = plan.nodes[node];
    std::ranges::sort(arms, [&](const NodeArm& a, const NodeArm& b) {
        return earlier_from_west(from, plan.nodes[a.end], plan.nodes[b.end]);
    });
}

NodeStars::NodeStars(const Plan& plan) : arms_(plan.nodes.size()) {
    for (std::uint32_t e = 0; e < plan.edges.size(); ++e) {
        const PlanEdge& edge = plan.edges[e];
        arms_[edge.from].push_back({e, edge.to, edge.left, edge.right});
        arms_[edge.to].push_back({e, edge.from, edge.right, edge.left});
    }
    for (std::uint32_t node = 0; node < arms_.size(); ++node)
        sort_around(plan, node, arms_[node]);
}

}  // namespace d2b

#include "surface/plan_part.hpp"

#include <algorithm>
#include <vector>

#include "surface/straighten.hpp"

namespace d2b {

Plan plan_part(const Plan& plan, std::span<const std::uint32_t> edges,
               const std::function<bool(std::int32_t)>& belongs) {
    Plan part;
    std::vector<std::uint32_t> nodes;
    for (const std::uint32_t e : edges) {
        PlanEdge edge = plan.edges[e];
        for (std::int32_t* contour : {&edge.left, &edge.right})
            if (*contour != open_ground && !belongs(*contour))
                *contour = open_ground;
        if (edge.left == edge.right)
            continue;
        part.edges.push_back(edge);
        nodes.push_back(edge.from);
        nodes.push_back(edge.to);
    }
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (const std::uint32_t node : nodes)
        part.nodes.push_back(plan.nodes[node]);
    for (PlanEdge& edge : part.edges)
        for (std::uint32_t* node : {&edge.from, &edge.to})
            *node = static_cast<std::uint32_t>(std::ranges::lower_bound(nodes, *node) - nodes.begin());
    straighten(part, Straighten::all);
    return part;
}

}  // namespace d2b

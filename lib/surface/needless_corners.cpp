#include "surface/needless_corners.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace d2b::surface {
namespace {

constexpr double straight_m = 0.001;

}  // namespace

void take_needless_corners(PartitionEditor& plan, const FlowMetric& metric,
                           const std::function<bool(std::uint32_t)>& may_go) {
    const double step =
        std::max(std::hypot(metric.col_x, metric.col_y), std::hypot(metric.row_x, metric.row_y));
    const double limit = std::max(straight_m, step);
    std::vector<double> moved(plan.edges().size());  // distance per edge from the corners that it lost, m
    for (std::uint32_t node = 0; node < plan.nodes().size(); ++node) {
        if (plan.degree(node) != 2 || !may_go(node))
            continue;
        const std::vector<IncidentEdge> arms = plan.around(node);
        if (arms[0].end == arms[1].end || plan.edge_between(arms[0].end, arms[1].end))
            continue;
        const double off = metric.distance_to(plan.at(node), plan.at(arms[0].end), plan.at(arms[1].end)) +
                           std::max(moved[arms[0].edge], moved[arms[1].edge]);
        if (off <= limit && plan.merge(node, arms[0].end))
            moved[arms[1].edge] = off;
    }
}

}  // namespace d2b::surface

#include "flow/block_areas.hpp"

#include <cmath>

#include "core/disjoint_sets.hpp"

namespace d2b {
namespace {

double area_of(const FineRing& ring, const FlowMetric& metric) {
    double twice = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        const FinePoint a = ring[0];
        twice += static_cast<double>(ring[i].row - a.row) * static_cast<double>(ring[i + 1].col - a.col) -
                 static_cast<double>(ring[i].col - a.col) * static_cast<double>(ring[i + 1].row - a.row);
    }
    return std::abs(twice) / 2 * metric.area();
}

}  // namespace

std::vector<double> block_areas(std::span<const PlanContour> contours, std::span<const PlanEdge> edges,
                                const FlowMetric& metric) {
    DisjointSets sets(static_cast<std::uint32_t>(contours.size()));
    for (std::uint32_t c = 0; c < contours.size(); ++c)
        if (contours[c].parent >= 0)
            sets.join(c, static_cast<std::uint32_t>(contours[c].parent));
    for (const PlanEdge& edge : edges)
        if (edge.left != open_ground && edge.right != open_ground)
            sets.join(static_cast<std::uint32_t>(edge.left), static_cast<std::uint32_t>(edge.right));
    std::vector<double> sums(contours.size(), 0);
    for (std::uint32_t c = 0; c < contours.size(); ++c) {
        if (contours[c].parent >= 0)
            continue;
        double& sum = sums[sets.find(c)];
        sum += area_of(contours[c].outline.exterior, metric);
        for (const FineRing& hole : contours[c].outline.interiors)
            sum -= area_of(hole, metric);
    }
    std::vector<double> areas;
    for (std::uint32_t c = 0; c < contours.size(); ++c)
        areas.push_back(sums[sets.find(c)]);
    return areas;
}

}  // namespace d2b

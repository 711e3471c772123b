#include "surface/block_budget.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/disjoint_sets.hpp"

namespace d2b::surface {
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

BlockBudget::BlockBudget(std::span<const PartitionContour> contours, std::span<const PartitionEdge> edges,
                         const FlowLimits& limits)
    : most_(contours.size(), 0), taken_(contours.size(), 0) {
    DisjointSets sets(static_cast<std::uint32_t>(contours.size()));
    for (std::uint32_t c = 0; c < contours.size(); ++c)
        if (contours[c].parent >= 0)
            sets.join(c, static_cast<std::uint32_t>(contours[c].parent));
    for (const PartitionEdge& edge : edges)
        if (edge.left != open_ground && edge.right != open_ground)
            sets.join(static_cast<std::uint32_t>(edge.left), static_cast<std::uint32_t>(edge.right));
    for (std::uint32_t c = 0; c < contours.size(); ++c) {
        block_.push_back(sets.find(c));
        if (contours[c].parent >= 0)
            continue;
        double& most = most_[block_.back()];
        most += limits.share * area_of(contours[c].outline.exterior, limits.metric);
        for (const FineRing& hole : contours[c].outline.interiors)
            most -= limits.share * area_of(hole, limits.metric);
    }
}

std::vector<std::uint32_t> BlockBudget::blocks_of(std::span<const std::int32_t> contours) const {
    std::vector<std::uint32_t> blocks;
    for (const std::int32_t contour : contours)
        if (contour != open_ground)
            blocks.push_back(block_[static_cast<std::size_t>(contour)]);
    std::ranges::sort(blocks);
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
}

bool BlockBudget::allows(std::span<const std::int32_t> contours, double outside, double inside) const {
    return std::ranges::all_of(blocks_of(contours), [&](std::uint32_t block) {
        return taken_[block] + outside <= most_[block] && outside + inside <= most_[block];
    });
}

void BlockBudget::take(std::span<const std::int32_t> contours, double outside) {
    for (const std::uint32_t block : blocks_of(contours))
        taken_[block] += outside;
}

}  // namespace d2b::surface

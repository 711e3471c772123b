#include "surface/level_roofs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <queue>
#include <set>
#include <tuple>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "outline/fine_geometry.hpp"
#include "surface/partition.hpp"

namespace d2b::surface {
namespace {

constexpr double most_share = 0.01;  // of a block's volume

/// Visible part of a contour, or of several that have been merged.
struct Roof {
    double area = 0;    // square steps
    double height = 0;  // steps
    std::int64_t highest_base = std::numeric_limits<std::int64_t>::min();
    std::set<std::uint32_t> neighbours;
};

class RoofLeveler {
  public:
    RoofLeveler(const SurfaceCluster& cluster, const PlanarPartition& plan, std::int64_t least);

    void run(const PlanarPartition& plan);
    [[nodiscard]] std::int64_t top(std::int32_t contour) {
        return std::llround(roofs_[find(static_cast<std::uint32_t>(contour))].height);
    }

  private:
    using Pair = std::tuple<double, std::uint32_t, std::uint32_t>;  // height difference, and the two roofs
    [[nodiscard]] std::uint32_t find(std::uint32_t roof) { return merged_.find(roof); }
    [[nodiscard]] double step(std::uint32_t a, std::uint32_t b) const {
        return std::abs(roofs_[a].height - roofs_[b].height);
    }
    void consider(std::uint32_t a, std::uint32_t b);
    void join(std::uint32_t a, std::uint32_t b);

    double least_;
    std::vector<Roof> roofs_;
    DisjointSets merged_;               // merged contours
    std::vector<std::uint32_t> block_;  // by contour
    std::vector<double> budget_;        // volume that a block may still move
    std::priority_queue<Pair, std::vector<Pair>, std::greater<>> queue_;
    bool joined_ = false;  // true if a merge happened in this pass
};

RoofLeveler::RoofLeveler(const SurfaceCluster& cluster, const PlanarPartition& plan, std::int64_t least)
    : least_(static_cast<double>(least)),
      roofs_(cluster.contours.size()),
      merged_(static_cast<std::uint32_t>(cluster.contours.size())),
      budget_(cluster.contours.size()) {
    const auto count = static_cast<std::uint32_t>(roofs_.size());
    DisjointSets blocks(count);
    for (const PartitionEdge& edge : plan.edges) {
        const double under = static_cast<double>(outline::turn(plan.nodes.front(), plan.nodes[edge.from],
                                                               plan.nodes[edge.to])) /
                             2;
        if (edge.left != open_ground)
            roofs_[static_cast<std::size_t>(edge.left)].area += under;
        if (edge.right != open_ground)
            roofs_[static_cast<std::size_t>(edge.right)].area -= under;
        if (edge.left == open_ground || edge.right == open_ground)
            continue;
        const auto a = static_cast<std::uint32_t>(edge.left);
        const auto b = static_cast<std::uint32_t>(edge.right);
        roofs_[a].neighbours.insert(b);
        roofs_[b].neighbours.insert(a);
        blocks.join(a, b);
    }
    for (std::uint32_t c = 0; c < count; ++c) {
        const PartitionContour& contour = cluster.contours[c];
        const std::int64_t base = cluster.buildings[static_cast<std::size_t>(contour.building)].base;
        roofs_[c].height = static_cast<double>(contour.top);
        roofs_[c].highest_base = base;
        block_.push_back(blocks.find(c));
        budget_[block_.back()] +=
            most_share * roofs_[c].area * static_cast<double>(std::max<std::int64_t>(contour.top - base, 0));
    }
}

void RoofLeveler::consider(std::uint32_t a, std::uint32_t b) {
    if (a != b && step(a, b) < least_)
        queue_.emplace(step(a, b), std::min(a, b), std::max(a, b));
}

void RoofLeveler::join(std::uint32_t a, std::uint32_t b) {
    Roof& one = roofs_[a];
    Roof& other = roofs_[b];
    const double area = one.area + other.area;
    const double height = area > 0 ? (one.area * one.height + other.area * other.height) / area
                                   : (one.height + other.height) / 2;
    const double more =
        one.area * std::abs(height - one.height) + other.area * std::abs(height - other.height);
    double& left = budget_[block_[a]];
    const std::int64_t base = std::max(one.highest_base, other.highest_base);
    if (more > left || std::llround(height) <= base)
        return;
    left -= more;
    joined_ = true;
    const std::uint32_t whole = merged_.join(a, b);
    Roof& roof = roofs_[whole];
    // The shorter list is merged into the longer one, and only its neighbours are considered now, because a
    // large roof may have any number of neighbours. The others are considered when they reach the front of
    // the queue.
    std::set<std::uint32_t> neighbours = std::move(roofs_[whole == a ? b : a].neighbours);
    if (neighbours.size() > roof.neighbours.size())
        std::swap(neighbours, roof.neighbours);
    roof.area = area;
    roof.height = height;
    roof.highest_base = base;
    for (const std::uint32_t neighbour : neighbours)
        consider(whole, find(neighbour));
    roof.neighbours.merge(neighbours);
}

void RoofLeveler::run(const PlanarPartition& plan) {
    constexpr int most_passes = 4;
    joined_ = true;
    for (int pass = 0; pass < most_passes && std::exchange(joined_, false); ++pass) {
        for (const PartitionEdge& edge : plan.edges)
            if (edge.left != open_ground && edge.right != open_ground)
                consider(find(static_cast<std::uint32_t>(edge.left)),
                         find(static_cast<std::uint32_t>(edge.right)));
        while (!queue_.empty()) {
            const auto [step_then, first, second] = queue_.top();
            queue_.pop();
            const std::uint32_t a = find(first);
            const std::uint32_t b = find(second);
            if (a == b)
                continue;
            if (step(a, b) == step_then)
                join(a, b);
            else
                consider(a, b);
        }
    }
}

}  // namespace

std::vector<RoofStep> level_roofs(SurfaceCluster& cluster, std::int64_t least) {
    const PartitionResult partition = make_partition(cluster.contours);
    if (least <= 0 || !partition.conflicting.empty() || partition.plan.edges.empty())
        return {};
    const PlanarPartition& plan = partition.plan;
    RoofLeveler leveler(cluster, plan, least);
    leveler.run(plan);
    std::vector<RoofStep> steps;
    std::set<std::pair<std::int32_t, std::int32_t>> known;
    const auto before = [&](std::int32_t contour) {
        return cluster.contours[static_cast<std::size_t>(contour)].top;
    };
    for (const PartitionEdge& edge : plan.edges) {
        if (edge.left == open_ground || edge.right == open_ground ||
            !known.insert(std::minmax({edge.left, edge.right})).second)
            continue;
        const RoofStep step{{std::min(edge.left, edge.right), std::max(edge.left, edge.right)},
                            plan.nodes[edge.from],
                            std::abs(before(edge.left) - before(edge.right)),
                            std::abs(leveler.top(edge.left) - leveler.top(edge.right))};
        const bool was_low = step.before > 0 && step.before < least;
        const bool is_low = step.after > 0 && step.after < least;
        if ((was_low && step.after != step.before) || is_low)
            steps.push_back(step);
    }
    for (std::size_t c = 0; c < cluster.contours.size(); ++c)
        cluster.contours[c].top = leveler.top(static_cast<std::int32_t>(c));
    return steps;
}

}  // namespace d2b::surface

#include "outline/walls/reference_direction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace d2b {
namespace {

constexpr double nearly = 12.0 / 180 * std::numbers::pi;
constexpr std::size_t short_chain = 16;  // steps
constexpr int lowest_rank =
    3;  // rank of walls between footprints; those of chains that stand on them are higher

/// First chain of the outline of the footprint below the contours at an arc.
std::uint32_t footprint_chain(const WallGraph& graph, const WallCluster& cluster, std::uint32_t arc) {
    const WallGraph::Sides& sides = graph.sides[arc];
    auto contour = static_cast<std::int64_t>(std::max(sides.left, sides.right));
    while (contour >= 0 && cluster.contours[static_cast<std::size_t>(contour)]->key.level > 1)
        contour = cluster.parents[static_cast<std::size_t>(contour)];
    if (contour < 0)
        return WallGraph::nobody;
    return graph.chain_of[graph.graph.outlines[static_cast<std::size_t>(contour)].exterior.front().arc];
}

}  // namespace

std::uint32_t reference_chain(const WallGraph& graph, const WallCluster& cluster, std::uint32_t c) {
    const Chain& chain = graph.chains[c];
    if (chain.rank < lowest_rank)
        return WallGraph::nobody;
    std::uint32_t base = chain.closed ? WallGraph::nobody : graph.nodes[chain.nodes.front()].owner;
    if (base == WallGraph::nobody)
        base = footprint_chain(graph, cluster, chain.arcs.front().arc);
    if (base == WallGraph::nobody || graph.chains[base].rank >= chain.rank)
        return WallGraph::nobody;
    return base;
}

double follow_direction(double own, double reference, std::size_t steps) {
    constexpr double right = std::numbers::pi / 2;
    const double turn = own - reference - std::round((own - reference) / right) * right;
    return steps < short_chain || std::abs(turn) < nearly ? reference : own;
}

}  // namespace d2b

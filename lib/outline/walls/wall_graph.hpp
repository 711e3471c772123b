#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/grouped_indices.hpp"
#include "outline/arc_graph.hpp"
#include "outline/walls/wall_clusters.hpp"

namespace d2b::outline {

/// A sequence of arcs fitted at once: a ring, or a path between two nodes. It does not depend on the chains
/// that end on it. An open chain begins at its smaller end. A closed one begins at its first point in scan
/// order and runs along the row, although its first arc may begin later.
struct Chain {
    int rank = 0;
    int higher = 0;  ///< side on which contours of its own level lie: 1 left, -1 right, 0 both
    bool closed = false;
    double step = 0;  ///< quadratic mean of the differences of tiers on both sides; 0 if it is unknown
    std::vector<ArcUse> arcs;
    std::vector<std::uint32_t> nodes;       ///< first nodes of its arcs, and the end node of the last
    std::vector<std::uint32_t> node_steps;  ///< unit steps from its first point to each node, ascending
    std::vector<LatticePoint> trace;  ///< corners and ends; a closed one does not repeat its first point

    [[nodiscard]] std::size_t steps() const { return node_steps.back() - node_steps.front(); }
    [[nodiscard]] std::uint32_t end_node(bool last) const { return last ? nodes.back() : nodes.front(); }
};

/// Arcs of all outlines in drawing order. The rank of an arc defines that order: outlines of a low level
/// precede those of a high one, and within a level the boundary of a group of touching contours precedes the
/// boundaries between them. Chains of one rank pass straight through nodes that only arcs of higher rank
/// join, because a wall must not depend on the walls that end on it.
struct WallGraph {
    static constexpr std::uint32_t none = 0xffffffff;
    static constexpr int highest_low_rank = 3;  ///< highest rank of arcs of levels 0 and 1

    /// Highest contours on both sides of an arc, as indices in the cluster; -1 if there is none.
    struct Sides {
        std::int32_t left = -1;
        std::int32_t right = -1;
    };
    struct Node {
        LatticePoint at;
        std::uint32_t owner = none;  ///< chain that passes through it; `none` if it keeps its traced position
        std::uint32_t place = 0;     ///< index among the nodes of the owner
    };

    ArcGraph graph;
    std::vector<Sides> sides;                        ///< per arc
    std::vector<int> ranks;                          ///< per arc
    std::vector<std::array<std::uint32_t, 2>> ends;  ///< end nodes per arc
    std::vector<Node> nodes;                         ///< sorted by position
    std::vector<Chain> chains;                       ///< sorted by rank
    std::vector<std::uint32_t> chain_of;             ///< per arc
    std::vector<std::uint32_t> index_in_chain;       ///< per arc: its index within its chain
    std::vector<std::uint32_t> component_of;         ///< per chain: its connected component

    GroupedIndices arcs_of;  ///< per component
    GroupedIndices ends_at;  ///< per node: 2 * arc if the arc begins there, 2 * arc + 1 if it ends there

    /// Contour on the left (counter-clockwise) side of an arc that leaves a node.
    [[nodiscard]] std::int32_t side_after(std::uint32_t end) const {
        return end % 2 == 0 ? sides[end / 2].left : sides[end / 2].right;
    }
    [[nodiscard]] std::int32_t side_before(std::uint32_t end) const {
        return end % 2 == 0 ? sides[end / 2].right : sides[end / 2].left;
    }
};

/// O(n log n) in the number of corners. @throws Cancelled
[[nodiscard]] WallGraph build_wall_graph(const WallCluster& cluster, const StopToken& stop);

}  // namespace d2b::outline

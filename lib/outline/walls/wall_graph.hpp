#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "outline/arc_graph.hpp"
#include "outline/walls/wall_clusters.hpp"

namespace d2b {

/// A run of arcs that is fitted in one go: a ring, or a stretch between two points where others stand. What
/// it is does not depend on what stands on it: an open chain begins at the smaller of its ends, a closed one
/// at its first point in scan order and runs along the row from there; but its first arc may begin later.
struct Chain {
    int rank = 0;
    int higher = 0;  ///< the side on which contours of its own level lie: 1 the left, -1 the right, 0 both
    bool closed = false;
    std::vector<ArcUse> arcs;
    std::vector<std::uint32_t> nodes;       ///< at which its arcs begin, and the last one's end
    std::vector<std::uint32_t> node_steps;  ///< unit steps from its first point to each of these, ascending
    std::vector<LatticePoint> trace;  ///< corners and ends; a closed one does not repeat its first point

    [[nodiscard]] std::size_t steps() const { return node_steps.back() - node_steps.front(); }
    [[nodiscard]] std::uint32_t end_node(bool last) const { return last ? nodes.back() : nodes.front(); }
};

/// The arcs of all outlines, in the order in which walls are drawn. An arc's rank says when: outlines of a
/// low level come before those of a high one, and within a level what bounds a group of touching contours
/// comes before what divides it. Chains of one rank go straight through a node where only arcs of higher rank
/// join: a wall knows nothing of what stands on it.
struct WallGraph {
    static constexpr std::uint32_t nobody = 0xffffffff;
    static constexpr int highest_low_rank = 3;  ///< of arcs of levels 0 and 1

    /// The highest contours on both sides of an arc, as places in the cluster; -1 where there is none.
    struct Sides {
        std::int32_t left = -1;
        std::int32_t right = -1;
    };
    struct Node {
        LatticePoint at;
        std::uint32_t owner = nobody;  ///< the chain that goes through it; nobody: it is where it was traced
        std::uint32_t place = 0;       ///< among the owner's nodes
    };

    ArcGraph graph;
    std::vector<Sides> sides;                        ///< of an arc
    std::vector<int> ranks;                          ///< of an arc
    std::vector<std::array<std::uint32_t, 2>> ends;  ///< nodes of an arc
    std::vector<Node> nodes;                         ///< sorted by place
    std::vector<Chain> chains;                       ///< sorted by rank
    std::vector<std::uint32_t> chain_of;             ///< an arc
    std::vector<std::uint32_t> place_of;             ///< an arc among those of its chain
    std::vector<std::uint32_t> part_of;  ///< a chain: number of the connected part that it belongs to
    std::uint32_t parts = 0;

    /// Arc ends at each node, as 2 * arc, and + 1 where it ends there; those of node n stand from
    /// first_end[n] on.
    std::vector<std::uint32_t> arc_ends;
    std::vector<std::uint32_t> first_end;

    [[nodiscard]] std::span<const std::uint32_t> ends_at(std::uint32_t node) const {
        return std::span(arc_ends).subspan(first_end[node], first_end[node + 1] - first_end[node]);
    }
    /// The contour beside an arc that leaves a node, on its counter-clockwise side: its left.
    [[nodiscard]] std::int32_t side_after(std::uint32_t end) const {
        return end % 2 == 0 ? sides[end / 2].left : sides[end / 2].right;
    }
    [[nodiscard]] std::int32_t side_before(std::uint32_t end) const {
        return end % 2 == 0 ? sides[end / 2].right : sides[end / 2].left;
    }
};

/// O(n log n) in corners. @throws Cancelled
[[nodiscard]] WallGraph build_wall_graph(const WallCluster& cluster, const StopRequest& stop);

}  // namespace d2b

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/int128.hpp"
#include "surface/edge_grid.hpp"
#include "surface/node_star.hpp"
#include "surface/plan.hpp"

namespace d2b {

/// Edits a plan in steps that keep it planar and the sides of its edges consistent; other changes are
/// refused. Exact. Node numbers are stable; merged nodes have no edges.
class PlanEditor {
  public:
    explicit PlanEditor(Plan plan);

    [[nodiscard]] const std::vector<FinePoint>& nodes() const { return nodes_; }
    [[nodiscard]] FinePoint at(std::uint32_t node) const { return nodes_[node]; }
    /// Returns all edges, including removed ones, see is_edge().
    [[nodiscard]] const std::vector<PlanEdge>& edges() const { return edges_; }
    [[nodiscard]] bool is_edge(std::uint32_t edge) const {
        return edge < edges_.size() && edges_[edge].from != edges_[edge].to;
    }
    /// Returns the edges around a node, counter-clockwise.
    [[nodiscard]] std::vector<NodeArm> around(std::uint32_t node) const;
    [[nodiscard]] std::size_t degree(std::uint32_t node) const { return at_node_[node].size(); }
    [[nodiscard]] std::optional<std::uint32_t> edge_between(std::uint32_t a, std::uint32_t b) const;
    /// Calls visit(edge) for edges that may meet a box, in any order and possibly repeatedly, until it
    /// returns false. @return true if it never returned false
    template <typename Visit>
    bool all_near(FinePoint low, FinePoint high, const Visit& visit) const {
        return grid_.all_in_box(low, high, [&](std::uint32_t edge) { return !is_edge(edge) || visit(edge); });
    }
    /// Calls visit(edge) for edges that may come within a distance of a segment, in any order and possibly
    /// repeatedly. @param reach in steps
    template <typename Visit>
    void each_near(FinePoint a, FinePoint b, std::int64_t reach, const Visit& visit) const {
        const auto look = [&](std::uint32_t edge) {
            if (is_edge(edge))
                visit(edge);
            return true;
        };
        grid_.all_in_triangle(a, b, b, look, reach);
    }

    /// Returns twice the area that a node's edges sweep when it moves to a place, in square steps.
    [[nodiscard]] Int128 swept(std::uint32_t node, FinePoint place) const;
    /// Returns the same for edges next to open ground only.
    [[nodiscard]] Int128 swept_outside(std::uint32_t node, FinePoint place) const;
    /// Merges a node into another one and removes the area between edges that become equal. @return true on
    /// success
    [[nodiscard]] bool merge(std::uint32_t node, std::uint32_t into);
    /// Splits an edge at a point on it or next to it, which becomes a node of the edge. @return nothing if
    /// that is impossible
    [[nodiscard]] std::optional<std::uint32_t> split(std::uint32_t edge, FinePoint place);
    /// Undoes splits, latest first, until `nodes` nodes are left. @pre no merge since
    void unsplit_to(std::size_t nodes);
    /// Returns the current and former ends of all edges changed since the last call, as pairs of nodes.
    [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> take_changes() {
        return std::exchange(changes_, {});
    }
    /// Returns the current plan without unused nodes.
    [[nodiscard]] Plan plan() const;

  private:
    /// State changed by merge(), for rolling back.
    struct Undo {
        std::vector<std::pair<std::uint32_t, PlanEdge>> edges;
        std::vector<std::pair<std::uint32_t, std::vector<std::uint32_t>>> nodes;
    };
    void index(std::uint32_t edge) { grid_.add(edge, nodes_[edges_[edge].from], nodes_[edges_[edge].to]); }
    [[nodiscard]] bool may_split(std::uint32_t edge, FinePoint place) const;
    [[nodiscard]] std::uint32_t other_end(std::uint32_t edge, std::uint32_t node) const {
        return edges_[edge].from == node ? edges_[edge].to : edges_[edge].from;
    }
    [[nodiscard]] Int128 swept_by(std::uint32_t edge, std::uint32_t node, FinePoint place) const;
    [[nodiscard]] bool is_way_free(std::uint32_t node, std::uint32_t into, std::uint32_t end) const;
    [[nodiscard]] bool is_clear_of(std::uint32_t edge, std::uint32_t from, FinePoint to) const;
    [[nodiscard]] std::optional<std::set<std::uint32_t>> ends_that_follow(std::uint32_t node,
                                                                          std::uint32_t into) const;
    [[nodiscard]] Undo remember(std::uint32_t node, std::uint32_t into,
                                const std::set<std::uint32_t>& ends) const;
    [[nodiscard]] bool move_edge(std::uint32_t edge, std::uint32_t node, std::uint32_t into);
    void detach(std::uint32_t edge, std::uint32_t node);
    void remove(std::uint32_t edge);
    [[nodiscard]] bool combine(std::uint32_t gone, std::uint32_t stays, std::uint32_t from);
    [[nodiscard]] bool agrees(std::uint32_t node) const;

    std::vector<FinePoint> nodes_;
    std::vector<PlanEdge> edges_;
    std::vector<std::vector<std::uint32_t>> at_node_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> changes_;
    EdgeGrid grid_;
};

}  // namespace d2b

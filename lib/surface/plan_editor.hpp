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

/// Changes a plan in steps that leave it planar and its sides in agreement, exactly; what would not is
/// refused. Nodes keep their numbers; those that are merged have no edges any more.
class PlanEditor {
  public:
    explicit PlanEditor(Plan plan);

    [[nodiscard]] const std::vector<FinePoint>& nodes() const { return nodes_; }
    [[nodiscard]] FinePoint at(std::uint32_t node) const { return nodes_[node]; }
    /// Also those that are gone, see is_edge().
    [[nodiscard]] const std::vector<PlanEdge>& edges() const { return edges_; }
    [[nodiscard]] bool is_edge(std::uint32_t edge) const {
        return edge < edges_.size() && edges_[edge].from != edges_[edge].to;
    }
    /// Counter-clockwise.
    [[nodiscard]] std::vector<NodeArm> around(std::uint32_t node) const;
    [[nodiscard]] std::size_t degree(std::uint32_t node) const { return at_node_[node].size(); }
    [[nodiscard]] std::optional<std::uint32_t> edge_between(std::uint32_t a, std::uint32_t b) const;
    /// Calls visit(edge) for edges that may meet a box, in any order, some more than once, until it returns
    /// false. @return whether it never did
    template <typename Visit>
    bool all_near(FinePoint low, FinePoint high, const Visit& visit) const {
        return grid_.all_in_box(low, high, [&](std::uint32_t edge) { return !is_edge(edge) || visit(edge); });
    }
    /// Calls visit(edge) for edges that may come so near a straight line, in any order, some more than once.
    /// @param reach in steps
    template <typename Visit>
    void each_near(FinePoint a, FinePoint b, std::int64_t reach, const Visit& visit) const {
        const auto look = [&](std::uint32_t edge) {
            if (is_edge(edge))
                visit(edge);
            return true;
        };
        grid_.all_in_triangle(a, b, b, look, reach);
    }

    /// Twice the area that a node's edges pass over when it moves to a place, in square steps.
    [[nodiscard]] Int128 swept(std::uint32_t node, FinePoint place) const;
    /// The same of edges that border on open ground.
    [[nodiscard]] Int128 swept_outside(std::uint32_t node, FinePoint place) const;
    /// Moves a node onto another one; what then lies between two equal edges is gone. @return whether it
    /// could
    [[nodiscard]] bool merge(std::uint32_t node, std::uint32_t into);
    /// Puts a node beside an edge or on it, which then runs through it. @return nothing where it cannot
    [[nodiscard]] std::optional<std::uint32_t> split(std::uint32_t edge, FinePoint place);
    /// Takes splits back, the last one first, until so many nodes are left. Nothing was merged since.
    void unsplit_to(std::size_t nodes);
    /// Where edges have begun, ended or run since this was last asked, as pairs of nodes.
    [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> take_changes() {
        return std::exchange(changes_, {});
    }
    /// What is left, with the nodes that are used.
    [[nodiscard]] Plan plan() const;

  private:
    /// What merge() has changed, to be put back.
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

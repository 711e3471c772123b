#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/int128.hpp"
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
    [[nodiscard]] bool is_edge(std::uint32_t edge) const { return edges_[edge].from != edges_[edge].to; }
    /// Counter-clockwise.
    [[nodiscard]] std::vector<NodeArm> around(std::uint32_t node) const;
    [[nodiscard]] std::size_t degree(std::uint32_t node) const { return at_node_[node].size(); }
    [[nodiscard]] std::optional<std::uint32_t> edge_between(std::uint32_t a, std::uint32_t b) const;
    /// Edges that may meet a box, in any order, some more than once.
    template <typename Visit>
    void near(FinePoint low, FinePoint high, const Visit& visit) const {
        for (std::int64_t row = cell(low.row); row <= cell(high.row); ++row)
            for (std::int64_t col = cell(low.col); col <= cell(high.col); ++col)
                if (const auto found = grid_.find({row, col}); found != grid_.end())
                    for (const std::uint32_t edge : found->second)
                        if (is_edge(edge))
                            visit(edge);
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
    /// What is left, with the nodes that are used.
    [[nodiscard]] Plan plan() const;

  private:
    struct CellHash {
        std::size_t operator()(const std::pair<std::int64_t, std::int64_t>& cell) const {
            return static_cast<std::size_t>(cell.first * 1000003 + cell.second);
        }
    };
    /// What merge() has changed, to be put back.
    struct Undo {
        std::vector<std::pair<std::uint32_t, PlanEdge>> edges;
        std::vector<std::pair<std::uint32_t, std::vector<std::uint32_t>>> nodes;
    };
    [[nodiscard]] static std::int64_t cell(std::int64_t at) { return at >> 11; }
    void index(std::uint32_t edge);
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
    std::unordered_map<std::pair<std::int64_t, std::int64_t>, std::vector<std::uint32_t>, CellHash> grid_;
};

}  // namespace d2b

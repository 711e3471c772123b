#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/int128.hpp"
#include "core/lattice.hpp"
#include "surface/planar_partition.hpp"

namespace d2b::surface {

/// Uniform grid index of the edges of a plan, with buckets of 4 x 4 cells. Modified edges are added again and
/// stay in their old buckets, so callers must test the edges themselves. A long edge costs its length, not
/// the area of its box.
class EdgeGrid {
  public:
    void add(std::uint32_t edge, FinePoint a, FinePoint b);

    /// Calls visit(edge) for all edges that may meet a box, in any order and possibly repeatedly, until it
    /// returns false. @return true if it never returned false
    template <typename Visit>
    bool all_in_box(FinePoint low, FinePoint high, const Visit& visit) const {
        for (std::int64_t row = cell(low.row - margin); row <= cell(high.row + margin); ++row)
            if (!all_in_row(row, cell(low.col - margin), cell(high.col + margin), visit))
                return false;
        return true;
    }
    /// Same for edges that may meet a triangle, or a segment if b == c.
    template <typename Visit>
    bool all_in_triangle(FinePoint a, FinePoint b, FinePoint c, const Visit& visit) const {
        const auto [first, last] = rows_of(a, b, c, margin);
        for (std::int64_t row = first; row <= last; ++row)
            if (const auto cols = cols_of(a, b, c, row, margin))
                if (!all_in_row(row, cols->first, cols->second, visit))
                    return false;
        return true;
    }

  private:
    using Range =
        std::pair<std::int64_t, std::int64_t>;  // range of buckets, inclusive; also a bucket's row and column
    struct StripHash {
        std::size_t operator()(const Range& strip) const {
            return static_cast<std::size_t>(strip.first * 1000003 + strip.second);
        }
    };
    static constexpr int bucket_bits = 12;
    [[nodiscard]] static std::int64_t cell(std::int64_t at) { return at >> bucket_bits; }
    /// Buckets of a row are hashed in strips of eight, because a search visits many that are side by side.
    static constexpr int strip_bits = 3;
    static constexpr std::int64_t strip_mask = (1 << strip_bits) - 1;
    using Strip = std::array<std::vector<std::uint32_t>, strip_mask + 1>;
    /// Margin of queries in steps, because a split may move an edge slightly without adding it again.
    static constexpr std::int64_t margin = 2;
    [[nodiscard]] static Range rows_of(FinePoint a, FinePoint b, FinePoint c, std::int64_t more);
    /// Returns the buckets of a row that a triangle covers.
    [[nodiscard]] static std::optional<Range> cols_of(FinePoint a, FinePoint b, FinePoint c, std::int64_t row,
                                                      std::int64_t more);

    template <typename Visit>
    bool all_in_row(std::int64_t row, std::int64_t first, std::int64_t last, const Visit& visit) const {
        for (std::int64_t col = first; col <= last;) {
            const auto strip = strips_.find({row, col >> strip_bits});
            const std::int64_t end = std::min(last, col | strip_mask);
            if (strip == strips_.end())
                col = end + 1;
            for (; col <= end; ++col)
                for (const std::uint32_t edge : strip->second[static_cast<std::size_t>(col & strip_mask)])
                    if (!visit(edge))
                        return false;
        }
        return true;
    }

    std::unordered_map<Range, Strip, StripHash> strips_;
};

/// Edits a plan in steps that keep it planar and the sides of its edges consistent; other changes are
/// refused. Exact. Node numbers are stable; merged nodes have no edges.
class PartitionEditor {
  public:
    explicit PartitionEditor(PlanarPartition plan);

    [[nodiscard]] const std::vector<FinePoint>& nodes() const { return nodes_; }
    [[nodiscard]] FinePoint at(std::uint32_t node) const { return nodes_[node]; }
    /// Returns all edges, including removed ones, see is_edge().
    [[nodiscard]] const std::vector<PartitionEdge>& edges() const { return edges_; }
    [[nodiscard]] bool is_edge(std::uint32_t edge) const {
        return edge < edges_.size() && edges_[edge].from != edges_[edge].to;
    }
    /// Returns the edges around a node, counter-clockwise.
    [[nodiscard]] std::vector<IncidentEdge> around(std::uint32_t node) const;
    /// Returns the same in no order, which costs far less.
    [[nodiscard]] std::vector<IncidentEdge> at_node(std::uint32_t node) const;
    [[nodiscard]] std::size_t degree(std::uint32_t node) const { return at_node_[node].size(); }
    [[nodiscard]] std::optional<std::uint32_t> edge_between(std::uint32_t a, std::uint32_t b) const;
    /// Calls visit(edge) for edges that may meet a box, in any order and possibly repeatedly, until it
    /// returns false. @return true if it never returned false
    template <typename Visit>
    bool all_near(FinePoint low, FinePoint high, const Visit& visit) const {
        return grid_.all_in_box(low, high, [&](std::uint32_t edge) { return !is_edge(edge) || visit(edge); });
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
    void undo_splits(std::size_t nodes);
    /// Returns the current and former ends of all edges changed since the last call, as pairs of nodes.
    [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> take_changes() {
        return std::exchange(changes_, {});
    }
    /// Returns the current plan without unused nodes.
    [[nodiscard]] PlanarPartition plan() const;

  private:
    /// State changed by merge(), for rolling back.
    struct Undo {
        std::vector<std::pair<std::uint32_t, PartitionEdge>> edges;
        std::vector<std::pair<std::uint32_t, std::vector<std::uint32_t>>> nodes;
    };
    void index(std::uint32_t edge) { grid_.add(edge, nodes_[edges_[edge].from], nodes_[edges_[edge].to]); }
    [[nodiscard]] bool may_split(std::uint32_t edge, FinePoint place) const;
    [[nodiscard]] std::uint32_t other_end(std::uint32_t edge, std::uint32_t node) const {
        return edges_[edge].from == node ? edges_[edge].to : edges_[edge].from;
    }
    [[nodiscard]] Int128 swept_by(std::uint32_t edge, std::uint32_t node, FinePoint place) const;
    [[nodiscard]] bool is_sweep_clear(std::uint32_t node, std::uint32_t into, std::uint32_t end) const;
    [[nodiscard]] bool is_disjoint_from(std::uint32_t edge, std::uint32_t from, FinePoint to) const;
    [[nodiscard]] std::optional<std::set<std::uint32_t>> movable_ends(std::uint32_t node,
                                                                      std::uint32_t into) const;
    [[nodiscard]] Undo remember(std::uint32_t node, std::uint32_t into,
                                const std::set<std::uint32_t>& ends) const;
    [[nodiscard]] bool move_edge(std::uint32_t edge, std::uint32_t node, std::uint32_t into);
    void detach(std::uint32_t edge, std::uint32_t node);
    void remove(std::uint32_t edge);
    [[nodiscard]] bool combine(std::uint32_t gone, std::uint32_t stays, std::uint32_t from);
    [[nodiscard]] bool agrees(std::uint32_t node) const;

    std::vector<FinePoint> nodes_;
    std::vector<PartitionEdge> edges_;
    std::vector<std::vector<std::uint32_t>> at_node_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> changes_;
    EdgeGrid grid_;
};

}  // namespace d2b::surface

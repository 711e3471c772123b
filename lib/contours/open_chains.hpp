#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "contours/runs.hpp"
#include "core/lattice.hpp"

namespace d2b::contours {

inline constexpr double nothing_outside = std::numeric_limits<double>::infinity();

/// Corner of an outline being traced.
struct Corner {
    LatticePoint at;
    bool non_manifold = false;         ///< the outline may pass here twice
    double outside = nothing_outside;  ///< lowest outside elevation along the edge that leads here
};

/// Outlines being traced. Each open outline is a chain of corners with two ends, both on vertical edges that
/// continue in the next row: the head runs down the left side of a run, the tail runs up the right side of a
/// run. The interior is on the left. Only corners are stored, so contour compression is free.
class OpenChains {
  public:
    struct Pair {
        std::uint32_t tail;
        std::uint32_t head;
    };
    /// Starts a chain: a horizontal edge joins tail and head.
    Pair open(Corner tail, Corner head);
    /// Sides of a run that come from rows not known yet.
    struct Sides {
        Pair below;
        Pair above;  ///< the downward chain begins at its tail, the upward chain ends at its head
    };
    /// Starts one chain down the left side of a run and one up its right side, each with a placeholder
    /// corner.
    Sides open_above(LatticePoint left, LatticePoint right);
    /// Extends the head to `turn`, along the row to `down`, and downwards.
    void extend_head(std::uint32_t chain_end, Corner turn, Corner down);
    /// Same at the tail, against the direction of the chain: `down`, then `turn`.
    void extend_tail(std::uint32_t chain_end, Corner turn, Corner down);
    /// Extends the head to `turn`, along the row to `up`, and upwards into the tail of the same or another
    /// chain.
    /// @return corners of the ring if this closes one, otherwise empty; valid until the next call
    std::span<const Corner> join(std::uint32_t head, Corner turn, Corner up, std::uint32_t tail);
    /// Same if a vertical edge joins the end of a chain to the beginning of another or the same chain.
    std::span<const Corner> connect(std::uint32_t head, std::uint32_t tail);
    /// Starts a chain of given corners, at least one.
    /// @param tail_outside, head_outside of the vertical edges to the first and from the last corner
    Pair add(std::span<const Corner> corners, double tail_outside, double head_outside);
    /// Appends the corners of the chain that begins at a tail. @return its head
    std::uint32_t copy_chain(std::uint32_t tail, std::vector<Corner>& to) const;
    /// Lowest outside elevation at a chain end since its last corner.
    [[nodiscard]] double outside(std::uint32_t chain_end) const { return ends_[chain_end].outside; }
    /// Upper bound of the numbers of chain ends.
    [[nodiscard]] std::size_t end() const { return ends_.size(); }
    /// Adds an outside elevation along the vertical edge at a chain end.
    void add_outside(std::uint32_t chain_end, double outside) {
        ChainEnd& a = ends_[chain_end];
        a.outside = outside < a.outside ? outside : a.outside;
    }

  private:
    struct Node {
        Corner corner;
        std::uint32_t next;
    };
    struct ChainEnd {
        std::uint32_t node;
        std::uint32_t mate;
        double outside;
    };
    std::uint32_t add_node(const Corner& corner, std::uint32_t next);
    std::uint32_t add_end(std::uint32_t node);
    Pair add_ends(std::uint32_t first, std::uint32_t last);
    void free_end(std::uint32_t chain_end);
    void set_outside(std::uint32_t node, double outside) { nodes_[node].corner.outside = outside; }
    std::span<const Corner> take_ring(std::uint32_t first, std::uint32_t last);

    std::vector<Node> nodes_;
    std::vector<ChainEnd> ends_;
    std::uint32_t free_node_ = no_index;
    std::uint32_t free_end_ = no_index;
    std::vector<Corner> ring_;  ///< the ring closed last
};

}  // namespace d2b::contours

#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/lattice.hpp"
#include "trace/runs.hpp"

namespace d2b {

inline constexpr double nothing_outside = std::numeric_limits<double>::infinity();

/// A corner of an outline while it is being traced.
struct Corner {
    LatticePoint at;
    bool pinch = false;                ///< the outline may pass here twice
    double outside = nothing_outside;  ///< lowest elevation outside, along the edge that leads here
};

/// Outlines in the making. Each open outline is a chain of corners with two ends, its arms, both on vertical
/// edges that go on into the next row: the head comes down the left side of a run, the tail goes up the right
/// side of one. What the outline bounds lies on its left. Only corners are kept: contour compression costs
/// nothing.
class Arms {
  public:
    struct Pair {
        std::uint32_t tail;
        std::uint32_t head;
    };
    /// Starts a chain: tail and head are joined by one horizontal edge.
    Pair open(Corner tail, Corner head);
    /// The sides of a run that come from rows which are not known yet.
    struct Sides {
        Pair below;
        Pair above;  ///< the chain that goes down begins at its tail, the one that goes up ends at its head
    };
    /// Starts a chain down the left side of a run and one up its right side, each with a corner that is none.
    Sides open_above(LatticePoint left, LatticePoint right);
    /// The head goes on to `turn`, along the row to `down`, and down.
    void extend_head(std::uint32_t arm, Corner turn, Corner down);
    /// The same at the tail, against the direction of the chain: down from `turn` after `down`.
    void extend_tail(std::uint32_t arm, Corner turn, Corner down);
    /// The head goes on to `turn`, along the row to `up`, and up into the tail of the same or of another
    /// chain.
    /// @return the corners of the ring that this closes, else none; valid until the next call
    std::span<const Corner> join(std::uint32_t head, Corner turn, Corner up, std::uint32_t tail);
    /// The same where one vertical edge leads from the end of a chain to the beginning of another or its own.
    std::span<const Corner> connect(std::uint32_t head, std::uint32_t tail);
    /// Starts a chain of corners that were found elsewhere, at least one.
    /// @param tail_outside, head_outside of the vertical edges that lead to the first and from the last
    Pair add(std::span<const Corner> corners, double tail_outside, double head_outside);
    /// Appends the corners of the chain that begins at an arm. @return the arm at which it ends
    std::uint32_t copy_chain(std::uint32_t tail, std::vector<Corner>& to) const;
    /// The least that an arm has passed since its last corner.
    [[nodiscard]] double outside(std::uint32_t arm) const { return arms_[arm].outside; }
    /// More than any arm's number.
    [[nodiscard]] std::size_t end() const { return arms_.size(); }
    /// Elevations outside along the vertical edge at an arm.
    void pass(std::uint32_t arm, double outside) {
        Arm& a = arms_[arm];
        a.outside = outside < a.outside ? outside : a.outside;
    }

  private:
    struct Node {
        Corner corner;
        std::uint32_t next;
    };
    struct Arm {
        std::uint32_t node;
        std::uint32_t mate;
        double outside;
    };
    std::uint32_t add_node(const Corner& corner, std::uint32_t next);
    std::uint32_t add_arm(std::uint32_t node);
    void free_arm(std::uint32_t arm);
    void set_outside(std::uint32_t node, double outside) { nodes_[node].corner.outside = outside; }
    std::span<const Corner> take_ring(std::uint32_t first, std::uint32_t last);

    std::vector<Node> nodes_;
    std::vector<Arm> arms_;
    std::uint32_t free_node_ = no_index;
    std::uint32_t free_arm_ = no_index;
    std::vector<Corner> ring_;  ///< closed last
};

}  // namespace d2b

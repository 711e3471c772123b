#pragma once

#include <cstddef>
#include <vector>

#include "outline/walls/wall_graph.hpp"

namespace d2b {

/// Puts the arcs of chains into their order for good and finds their traces, nodes and steps: the same
/// whatever divides a chain into arcs.
class ChainTracer {
  public:
    /// @param graph with arcs and their ends
    explicit ChainTracer(const WallGraph& graph) : graph_(graph) {}
    /// @param chain its arcs in either direction, from anywhere on
    void trace(Chain& chain);

  private:
    void gather(const Chain& chain);
    [[nodiscard]] bool runs_backwards(const Chain& chain) const;
    static void reverse(Chain& chain);
    void rotate(Chain& chain);
    void find_nodes(Chain& chain);
    void find_corners(Chain& chain);

    const WallGraph& graph_;
    std::vector<LatticePoint> points_;  // a closed chain's without repetition
    std::vector<std::size_t> begins_;   // of arcs among these
    std::vector<std::uint32_t> steps_;  // before each point, and of all
    std::size_t start_ = 0;             // point at which the trace begins
};

}  // namespace d2b

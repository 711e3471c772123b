#pragma once

#include <cstddef>
#include <vector>

#include "outline/walls/wall_graph.hpp"

namespace d2b {

/// Normalizes the order of the arcs of chains and derives their traces, nodes and steps. The result does not
/// depend on the division of a chain into arcs.
class ChainTracer {
  public:
    /// @param graph with arcs and their end nodes
    explicit ChainTracer(const WallGraph& graph) : graph_(graph) {}
    /// @param chain its arcs in either direction, starting anywhere
    void trace(Chain& chain);

  private:
    void gather(const Chain& chain);
    [[nodiscard]] bool runs_backwards(const Chain& chain) const;
    static void reverse(Chain& chain);
    void rotate(Chain& chain);
    void find_nodes(Chain& chain);
    void find_corners(Chain& chain);

    const WallGraph& graph_;
    std::vector<LatticePoint> points_;  // without repetition if the chain is closed
    std::vector<std::size_t> begins_;   // index in points_ at which each arc begins
    std::vector<std::uint32_t> steps_;  // number of steps before each point, and in total
    std::size_t start_ = 0;             // index of the point at which the trace begins
};

}  // namespace d2b

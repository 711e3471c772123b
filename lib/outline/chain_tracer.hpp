#pragma once

#include <cstddef>
#include <vector>

#include "outline/wall_graph.hpp"

namespace d2b {

/// Puts a chain's arcs into their order for good and finds its trace, nodes and steps: the same whatever
/// divides it into arcs.
class ChainTracer {
  public:
    /// @param graph with arcs and their ends @param chain its arcs in either direction, from anywhere on
    ChainTracer(const WallGraph& graph, Chain& chain) : graph_(graph), chain_(chain) {}
    void trace();

  private:
    void gather();
    [[nodiscard]] bool runs_backwards() const;
    void reverse();
    void rotate();
    void find_nodes();
    void find_corners();

    const WallGraph& graph_;
    Chain& chain_;
    std::vector<LatticePoint> points_;  // a closed chain's without repetition
    std::vector<std::size_t> begins_;   // of arcs among these
    std::vector<std::uint32_t> steps_;  // before each point, and of all
    std::size_t start_ = 0;             // point at which the trace begins
};

}  // namespace d2b

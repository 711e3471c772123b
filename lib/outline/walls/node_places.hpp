#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outline/walls/chain_state.hpp"
#include "outline/walls/wall_graph.hpp"

namespace d2b {

/// Where the nodes of a graph are: on the drawn form of the chain that goes through them, or where they were
/// traced.
class NodePlaces {
  public:
    /// @param states of the graph's chains, that it puts nodes on @param graph, states must outlive this
    NodePlaces(const WallGraph& graph, std::vector<ChainState>& states, const CellShape& shape)
        : graph_(graph), states_(states), shape_(shape) {}

    [[nodiscard]] FinePoint at(std::uint32_t node) const;
    /// How far a node is from where it was traced, in cells.
    [[nodiscard]] double displaced(std::uint32_t node) const;
    /// Puts the ends of a chain that has been drawn once onto those that it ends on, where they are not there
    /// yet.
    /// @return nothing for a closed chain
    [[nodiscard]] std::optional<ChainEnds> land_ends(std::uint32_t chain);

  private:
    [[nodiscard]] FinePoint land(std::uint32_t node, const std::optional<Line>& wall);
    [[nodiscard]] std::optional<Line> wall_at_end(std::uint32_t chain, bool last) const;

    const WallGraph& graph_;
    std::vector<ChainState>& states_;
    CellShape shape_;
};

}  // namespace d2b

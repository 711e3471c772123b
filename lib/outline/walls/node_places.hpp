#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outline/walls/chain_state.hpp"
#include "outline/walls/wall_graph.hpp"

namespace d2b {

/// Positions of the nodes of a graph: on the drawing of the chain that passes through them, or as traced.
class NodePlaces {
  public:
    /// @param states of the chains of the graph; nodes are placed on them @param graph, states must outlive
    /// this
    NodePlaces(const WallGraph& graph, std::vector<ChainState>& states, const CellShape& shape)
        : graph_(graph), states_(states), shape_(shape) {}

    [[nodiscard]] FinePoint at(std::uint32_t node) const;
    /// Distance of a node from its traced position, in cells.
    [[nodiscard]] double displaced(std::uint32_t node) const;
    /// Places the ends of a drawn chain on the chains at which it ends, unless they are placed already.
    /// @return nullopt for a closed chain
    [[nodiscard]] std::optional<ChainEnds> land_ends(std::uint32_t chain);

  private:
    [[nodiscard]] FinePoint land(std::uint32_t node, const std::optional<Line>& wall);
    [[nodiscard]] std::optional<Line> wall_at_end(std::uint32_t chain, bool last) const;

    const WallGraph& graph_;
    std::vector<ChainState>& states_;
    CellShape shape_;
};

}  // namespace d2b

#pragma once

#include <cstdint>
#include <vector>

#include "outline/walls/chain_state.hpp"
#include "outline/walls/node_places.hpp"
#include "outline/walls/wall_options.hpp"

namespace d2b {

/// Draws the chains of a graph by rank, lowest first. Chains that end on another chain end on its drawn form.
class WallDrawing {
  public:
    /// @param graph, cluster, stop must outlive this
    WallDrawing(const WallGraph& graph, const WallCluster& cluster, const WallOptions& options,
                const StopRequest& stop);
    WallDrawing(const WallDrawing&) = delete;
    WallDrawing& operator=(const WallDrawing&) = delete;
    ~WallDrawing() = default;

    /// Draws chains that are new or have a changed mode, and the chains that end on them.
    /// @return changed arcs @throws Cancelled
    [[nodiscard]] std::vector<std::uint32_t> draw();

    [[nodiscard]] const ChainForm& form(std::uint32_t chain) const { return states_[chain].form; }
    /// Extracts a drawn arc in its own direction, with the steps of its chain for each vertex.
    void arc(std::uint32_t arc, DrawnChain& drawn) const;
    /// Extracts the part of a chain that a ring uses, from one arc to another, in the direction of the chain,
    /// without the nodes between. @param whole true if the ring consists of the entire chain @return true if
    /// the ring runs against the chain
    bool stretch(const ArcUse& first, const ArcUse& last, bool whole, DrawnChain& drawn) const;
    /// Makes a range of steps of a chain, plus a margin on both sides, follow the trace more closely.
    /// @return false if it is as close as possible already
    bool follow_closer(std::uint32_t chain, std::size_t first, std::size_t last, std::size_t margin);
    /// Same for a whole chain.
    bool follow_closer(std::uint32_t chain) {
        return follow_closer(chain, 0, graph_.chains[chain].steps(), 0);
    }
    /// Same for the chain at a node, around the node, if the node is not at its traced position.
    bool follow_closer_at(std::uint32_t node, std::size_t margin);
    /// Sets all steps of a chain to the closest mode.
    void trace(std::uint32_t chain);
    /// Distance of a node from its traced position, in cells.
    [[nodiscard]] double displaced(std::uint32_t node) const { return places_.displaced(node); }

    /// A wall of a chain.
    struct Wall {
        std::uint32_t chain;
        std::size_t piece;
        friend auto operator<=>(const Wall&, const Wall&) = default;
    };
    /// Movable walls that lie mostly along one arc.
    [[nodiscard]] std::vector<Wall> walls_along(std::uint32_t arc) const;
    [[nodiscard]] double length(Wall wall) const;
    /// Moves a wall to the left of its chain; takes effect when the chain is redrawn.
    void shift(Wall wall, double cells);

  private:
    void reset(std::uint32_t node);
    [[nodiscard]] std::vector<std::uint32_t> changed_arcs(const std::vector<std::uint32_t>& drawn) const;
    void draw_chain(std::uint32_t chain);
    void plan(std::uint32_t chain);
    [[nodiscard]] double direction(std::uint32_t chain) const;

    const WallGraph& graph_;
    const WallCluster& cluster_;
    WallOptions options_;
    const StopRequest& stop_;
    std::vector<ChainState> states_;
    NodePlaces places_;
    std::vector<std::uint8_t> reset_;  ///< per node: placed anew in this call
    bool first_ = true;                ///< before the first call of draw()
};

}  // namespace d2b

#pragma once

#include <cstdint>
#include <vector>

#include "outline/walls/node_placement.hpp"
#include "outline/walls/wall_clusters.hpp"

namespace d2b::outline {

/// Draws the chains of a graph by rank, lowest first. Chains that end on another chain end on its drawn form.
class WallLayout {
  public:
    /// @param graph, cluster, stop must outlive this
    WallLayout(const WallGraph& graph, const WallCluster& cluster, const WallOptions& options,
               const StopToken& stop);
    WallLayout(const WallLayout&) = delete;
    WallLayout& operator=(const WallLayout&) = delete;
    ~WallLayout() = default;

    /// Draws chains that are new or have a changed mode, and the chains that end on them.
    /// @return changed arcs @throws Cancelled
    [[nodiscard]] std::vector<std::uint32_t> draw();

    [[nodiscard]] const ChainFitMode& mode(std::uint32_t chain) const { return states_[chain].mode; }
    /// True if a chain has changed since it was drawn.
    [[nodiscard]] bool is_pending(std::uint32_t chain) const { return states_[chain].pending; }
    /// Extracts a drawn arc in its own direction, with the steps of its chain for each vertex.
    void arc(std::uint32_t arc, ChainPolyline& drawn) const;
    /// Extracts the part of a chain that a ring uses, from one arc to another, in the direction of the chain,
    /// without the nodes between. @param whole true if the ring consists of the entire chain @return true if
    /// the ring runs against the chain
    bool extract(const ArcUse& first, const ArcUse& last, bool whole, ChainPolyline& drawn) const;
    /// Makes a range of steps of a chain, plus a margin on both sides, follow the trace more closely.
    /// @return false if it is as close as possible already
    bool tighten(std::uint32_t chain, std::size_t first, std::size_t last, std::size_t margin);
    /// Divides a chain into more walls that lie closer. @return false if they are as many as possible already
    bool lower_price(std::uint32_t chain);
    /// Same for the chain at a node, around the node, if the node is not at its traced position.
    bool tighten_at(std::uint32_t node, std::size_t margin);
    /// Sets a range of steps of a chain, and those within the margin, to the closest mode.
    /// @return true if anything has changed
    bool use_trace(std::uint32_t chain, std::size_t first, std::size_t last, std::size_t margin);
    bool use_trace(std::uint32_t chain) { return use_trace(chain, 0, graph_.chains[chain].steps(), 0); }
    /// Distance of a node from its traced position, in cells.
    [[nodiscard]] double displacement(std::uint32_t node) const { return positions_.displacement(node); }

    /// A wall of a chain.
    struct Wall {
        std::uint32_t chain;
        std::size_t segment;
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
    /// Sets the frames of the chains that follow no other chain: of their own stretches, and of those of all
    /// chains of the footprints that share chains with theirs.
    void find_frames();
    [[nodiscard]] WallDirections directions(std::uint32_t chain) const;
    [[nodiscard]] ChainFitter& fitter(std::uint32_t chain);

    const WallGraph& graph_;
    const WallCluster& cluster_;
    WallOptions options_;
    const StopToken& stop_;
    std::vector<ChainState> states_;
    NodePositions positions_;
    std::vector<std::uint8_t> reset_;  ///< per node: placed anew in this call
    bool first_ = true;                ///< before the first call of draw()
};

}  // namespace d2b::outline

#pragma once

#include <cstdint>
#include <vector>

#include "outline/walls/chain_state.hpp"
#include "outline/walls/node_places.hpp"
#include "outline/walls/wall_options.hpp"

namespace d2b {

/// Draws the chains of a graph, those of low rank first; what ends on a chain ends on its drawn form.
class WallDrawing {
  public:
    /// @param graph, cluster, stop must outlive this
    WallDrawing(const WallGraph& graph, const WallCluster& cluster, const WallOptions& options,
                const StopRequest& stop);
    WallDrawing(const WallDrawing&) = delete;
    WallDrawing& operator=(const WallDrawing&) = delete;
    ~WallDrawing() = default;

    /// Draws the chains that are not drawn, or have been asked for another form, and what stands on them.
    /// @return the arcs that have changed @throws Cancelled
    [[nodiscard]] std::vector<std::uint32_t> draw();

    [[nodiscard]] const ChainForm& form(std::uint32_t chain) const { return states_[chain].form; }
    /// Gives an arc as it is drawn, in its own direction, with the steps of its chain that its vertices stand
    /// for.
    void arc(std::uint32_t arc, DrawnChain& drawn) const;
    /// Gives what a ring uses of a chain from one arc to another, in the chain's direction, without the nodes
    /// between. @param whole the ring is all of the chain @return whether the ring runs against the chain
    bool stretch(const ArcUse& first, const ArcUse& last, bool whole, DrawnChain& drawn) const;
    /// Lets a range of steps of a chain follow its trace closer, and some steps on either side.
    /// @return false: it is as close as can be
    bool follow_closer(std::uint32_t chain, std::size_t first, std::size_t last, std::size_t margin);
    /// The same for a whole chain.
    bool follow_closer(std::uint32_t chain) {
        return follow_closer(chain, 0, graph_.chains[chain].steps(), 0);
    }
    /// The same for the chain on which a node stands, around the node, if it is not where it was traced.
    bool follow_closer_at(std::uint32_t node, std::size_t margin);
    /// Gives all of a chain the closest form.
    void trace(std::uint32_t chain);
    /// How far a node is from where it was traced, in cells.
    [[nodiscard]] double displaced(std::uint32_t node) const { return places_.displaced(node); }

    /// A wall of a chain.
    struct Wall {
        std::uint32_t chain;
        std::size_t piece;
        friend auto operator<=>(const Wall&, const Wall&) = default;
    };
    /// The walls that stand along one arc for the most part, and may still be moved.
    [[nodiscard]] std::vector<Wall> walls_along(std::uint32_t arc) const;
    [[nodiscard]] double length(Wall wall) const;
    /// Moves a wall to the left of its chain when that is drawn next.
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
    std::vector<std::uint8_t> reset_;  ///< nodes that are placed anew this time
    bool first_ = true;                ///< nothing has been drawn
};

}  // namespace d2b

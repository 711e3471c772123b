#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outline/walls/chain_walls.hpp"
#include "outline/walls/course.hpp"
#include "outline/walls/draw_walls.hpp"
#include "outline/walls/wall_clusters.hpp"
#include "outline/walls/wall_options.hpp"

namespace d2b {

/// Draws the chains of a graph, those of low rank first; what ends on a chain ends on its drawn form.
class WallDrawing {
  public:
    enum class Form : std::uint8_t {
        fitted,
        joined,  ///< as traced, with ends on the drawn form of the chains that it ends on
        traced   ///< as traced; then the chains that it ends on are as well
    };

    /// @param graph, cluster, stop must outlive this
    WallDrawing(const WallGraph& graph, const WallCluster& cluster, const WallOptions& options,
                const StopRequest& stop);

    /// Takes over what has been drawn of the lower levels alone. To be called before anything is drawn.
    void adopt(WallDrawing&& low);
    /// Draws the chains that are not drawn, or have been asked for another form, and what stands on them;
    /// asks for simpler forms where a chain cannot have its own.
    /// @return the arcs that have changed @throws Cancelled
    [[nodiscard]] std::vector<std::uint32_t> draw();

    [[nodiscard]] Form form(std::uint32_t chain) const { return states_[chain].form; }
    /// The form in which it is drawn; traced: it and its nodes are where they were traced.
    [[nodiscard]] Form drawn(std::uint32_t chain) const { return states_[chain].drawn; }
    /// Gives an arc as it is drawn, in its own direction; steps are of no use.
    void arc(std::uint32_t arc, DrawnChain& drawn) const;
    /// The next simpler form of a chain, and of those that need one with it. @return false: it is traced
    /// already
    bool simplify(std::uint32_t chain);
    /// A wall of a chain.
    struct Wall {
        std::uint32_t chain;
        std::size_t piece;
        friend auto operator<=>(const Wall&, const Wall&) = default;
    };
    /// The walls of a fitted chain that stand along one of its arcs for the most part, and may still be
    /// moved.
    [[nodiscard]] std::vector<Wall> walls_along(std::uint32_t arc) const;
    [[nodiscard]] double length(Wall wall) const;
    /// Moves a wall to the left of its chain when that is drawn next.
    void shift(Wall wall, double cells);

  private:
    struct State {
        Form form = Form::fitted;
        Form drawn = Form::fitted;
        bool waiting = true;    ///< to be drawn for its own sake
        bool lands = false;     ///< where it ends may have moved
        std::size_t tried = 0;  ///< prices of walls
        double direction = 0;
        std::optional<ChainEnds> ends;    ///< of an open chain that is not traced
        std::optional<ChainWalls> walls;  ///< where it is fitted
        Course course;                    ///< where it is drawn fitted
    };
    [[nodiscard]] bool can_adopt(const Chain& chain, const std::vector<bool>& adopted) const;
    void adopt_chain(std::uint32_t chain, WallDrawing& low, std::uint32_t low_chain);
    void reset(std::uint32_t node);
    [[nodiscard]] bool ends_where_it_did(std::uint32_t chain);
    [[nodiscard]] std::vector<std::uint32_t> changed_arcs() const;
    void draw_chain(std::uint32_t chain);
    [[nodiscard]] bool fit(std::uint32_t chain);
    [[nodiscard]] bool plan(std::uint32_t chain, const std::vector<std::size_t>& points, double price);
    [[nodiscard]] bool join_walls(std::uint32_t chain);
    [[nodiscard]] double reference_direction(std::uint32_t chain, double own) const;
    [[nodiscard]] FinePoint place(std::uint32_t node) const;
    [[nodiscard]] FinePoint land(std::uint32_t node, const std::optional<Line>& wall);
    [[nodiscard]] std::optional<ChainEnds> land_ends(const Chain& chain, const WallPiece& first,
                                                     const WallPiece& last);
    void land_traced(std::uint32_t chain);
    void join(const Chain& chain, std::size_t k, DrawnChain& drawn) const;
    [[nodiscard]] static std::uint32_t end_node(const Chain& chain, bool last) {
        return last ? chain.nodes.back() : chain.nodes.front();
    }

    const WallGraph& graph_;
    const WallCluster& cluster_;
    WallOptions options_;
    const StopRequest& stop_;
    std::vector<State> states_;
    std::vector<bool> plain_;           ///< nodes that stay nearest to their trace
    std::vector<std::uint8_t> reset_;   ///< nodes that are placed anew this time
    std::vector<std::uint32_t> drawn_;  ///< chains, this time
    bool first_ = true;                 ///< nothing has been drawn
};

}  // namespace d2b

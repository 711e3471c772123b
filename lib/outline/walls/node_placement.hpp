#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "outline/walls/chain_fitter.hpp"
#include "outline/walls/chain_polyline.hpp"
#include "outline/walls/wall_graph.hpp"

namespace d2b::outline {

/// A drawn chain and the positions of the nodes on it.
class PlacedPolyline {
  public:
    PlacedPolyline() = default;
    /// @param mode of the chain; nodes in beveled stretches keep their traced positions
    /// @param samples of the chain; must outlive this @param tolerance cells
    PlacedPolyline(ChainPolyline drawn, const Chain& chain, const ChainFitMode& mode,
                   const TraceSums& samples, double tolerance);

    [[nodiscard]] std::optional<FinePoint> node(std::size_t k) const { return nodes_[k].point; }
    /// Places a node on the drawing, keeping the order of the trace and leaving room for nodes not placed
    /// yet.
    /// @param wall line of the wall that ends here; the node moves to its intersection if that is near
    void place(std::size_t k, const std::optional<Line2>& wall);
    void remove_node(std::size_t k) {
        if (nodes_[k].is_fixed)
            return;
        nodes_[k].point.reset();
        placed_.erase(k);
    }

    /// Extracts the drawing between two nodes, without nodes in between, with its own deviation and with the
    /// circular arcs that neither node splits.
    /// @param to_node in a closed chain, the first node follows the last
    void extract(std::size_t from_node, std::size_t to_node, ChainPolyline& drawn) const;
    /// Extracts a closed chain completely, without nodes.
    void whole(ChainPolyline& drawn) const;

  private:
    struct PlacedNode {
        std::optional<FinePoint> point;
        std::size_t step = 0;
        std::size_t edge = 0;
        double at = 0;          ///< distance along the drawing from its first vertex, in cells
        bool is_fixed = false;  ///< keeps its traced position
    };
    [[nodiscard]] bool closed() const { return samples_->closed(); }
    [[nodiscard]] std::size_t edges() const { return begins_.size() - 1; }
    [[nodiscard]] Vec2 traced(const PlacedNode& node) const { return samples_->at(node.step); }
    [[nodiscard]] Vec2 vertex(std::size_t k) const { return vertices_[k < vertices_.size() ? k : 0]; }
    [[nodiscard]] std::size_t edge_of(std::size_t step) const;
    [[nodiscard]] double preferred_position(const PlacedNode& node, const std::optional<Line2>& wall) const;
    void keep_traced(std::size_t k);
    void find_range(std::size_t k, double& low, double& high) const;
    void set_position(PlacedNode& node, double at);
    void cut(const PlacedNode& from, const PlacedNode& to, ChainPolyline& arc) const;
    void match(ChainPolyline& arc, std::size_t first, std::size_t last) const;
    void add_arcs(const PlacedNode& from, ChainPolyline& arc) const;

    const TraceSums* samples_ = nullptr;
    ChainPolyline drawn_;
    std::vector<Vec2> vertices_;   // positions of the vertices
    double max_displacement_ = 0;  // cells by which a node may be displaced for the sake of a wall or corner
    std::vector<PlacedNode> nodes_;  // including both ends if open
    std::set<std::size_t> placed_;   // nodes that have a point
    std::vector<double>
        begins_;  // distance along the drawing of the beginning of each edge, and the total length
};

/// State of a chain while its graph is being drawn.
struct ChainState {
    ChainFitMode mode;
    bool pending = true;      ///< has yet to be drawn for its own sake
    bool ends_moved = false;  ///< its end nodes may have moved
    WallDirections directions;
    std::optional<double> main_direction;  ///< of its own stretches, if it follows another chain
    std::size_t price = 0;                 ///< index of the price of its walls among those tried in turn
    std::optional<ChainEnds> ends;         ///< open chains only
    std::unique_ptr<ChainFitter> chain;    ///< set once it has been drawn
    PlacedPolyline polyline;
};

/// Positions of the nodes of a graph: on the drawing of the chain that passes through them, or as traced.
class NodePositions {
  public:
    /// @param states of the chains of the graph; nodes are placed on them @param graph, states must outlive
    /// this
    NodePositions(const WallGraph& graph, std::vector<ChainState>& states, const CellShape& shape)
        : graph_(graph), states_(states), shape_(shape) {}

    [[nodiscard]] FinePoint at(std::uint32_t node) const;
    /// Distance of a node from its traced position, in cells.
    [[nodiscard]] double displacement(std::uint32_t node) const;
    /// Places the ends of a drawn chain on the chains at which it ends, unless they are placed already.
    /// @return nullopt for a closed chain
    [[nodiscard]] std::optional<ChainEnds> place_ends(std::uint32_t chain);

  private:
    [[nodiscard]] FinePoint place_node(std::uint32_t node, const std::optional<Line2>& wall);
    [[nodiscard]] std::optional<Line2> wall_at_end(std::uint32_t chain, bool last) const;

    const WallGraph& graph_;
    std::vector<ChainState>& states_;
    CellShape shape_;
};

}  // namespace d2b::outline

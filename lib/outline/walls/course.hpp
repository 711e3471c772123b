#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "outline/walls/chain_form.hpp"
#include "outline/walls/drawn_chain.hpp"
#include "outline/walls/index_set.hpp"
#include "outline/walls/wall_graph.hpp"

namespace d2b {

/// A drawn chain and the positions of the nodes on it.
class Course {
  public:
    Course() = default;
    /// @param form of the chain; nodes in beveled stretches keep their traced positions
    /// @param tolerance cells
    Course(DrawnChain drawn, const Chain& chain, const ChainForm& form, const WallSamples& samples,
           const CellShape& shape, double tolerance);

    [[nodiscard]] const DrawnChain& drawn() const { return drawn_; }
    [[nodiscard]] std::optional<FinePoint> node(std::size_t k) const { return nodes_[k].point; }
    /// Places a node on the drawing, keeping the order of the trace and leaving room for nodes not placed
    /// yet.
    /// @param wall line of the wall that ends here; the node moves to its intersection if that is near
    void place(std::size_t k, const std::optional<Line>& wall);
    void take_away(std::size_t k) {
        if (nodes_[k].stays)
            return;
        nodes_[k].point.reset();
        placed_.erase(k);
    }

    /// Extracts the drawing between two nodes, without nodes in between, with its own deviation and with the
    /// circular arcs that neither node splits. @param samples of the chain
    /// @param to_node in a closed chain, the first node follows the last
    void stretch(std::size_t from_node, std::size_t to_node, const WallSamples& samples,
                 DrawnChain& drawn) const;
    /// Extracts a closed chain completely, without nodes.
    void whole(const WallSamples& samples, DrawnChain& drawn) const;

  private:
    struct Standing {
        std::optional<FinePoint> point;
        Vec traced;
        std::size_t step = 0;
        std::size_t edge = 0;
        double at = 0;       ///< distance along the drawing from its first vertex, in cells
        bool stays = false;  ///< keeps its traced position
    };
    [[nodiscard]] std::size_t edges() const { return begins_.size() - 1; }
    [[nodiscard]] Vec vertex(std::size_t k) const { return places_[k < places_.size() ? k : 0]; }
    [[nodiscard]] std::size_t edge_of(std::size_t step) const;
    [[nodiscard]] double wanted(const Standing& node, const std::optional<Line>& wall) const;
    void keep(std::size_t k);
    void bound(std::size_t k, double& low, double& high) const;
    void stand(Standing& node, double at);
    void cut(const Standing& from, const Standing& to, DrawnChain& arc) const;
    void match(DrawnChain& arc, std::size_t first, std::size_t last, std::size_t steps) const;
    void add_circles(const Standing& from, DrawnChain& arc) const;

    DrawnChain drawn_;
    std::vector<Vec> places_;  // positions of the vertices
    bool closed_ = false;
    CellShape shape_;
    LatticePoint origin_;
    double reach_ = 0;             // cells by which a node may be displaced for the sake of a wall or corner
    std::vector<Standing> nodes_;  // including both ends if open
    IndexSet placed_;              // nodes that have a point
    std::vector<double>
        begins_;  // distance along the drawing of the beginning of each edge, and the total length
};

}  // namespace d2b

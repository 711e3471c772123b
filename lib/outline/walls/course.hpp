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

/// A chain in its drawn form, with the places of the nodes that stand on it.
class Course {
  public:
    Course() = default;
    /// @param form of the chain: nodes in stretches that are cut stay where they were traced
    /// @param tolerance cells
    Course(DrawnChain drawn, const Chain& chain, const ChainForm& form, const WallSamples& samples,
           const CellShape& shape, double tolerance);

    [[nodiscard]] const DrawnChain& drawn() const { return drawn_; }
    [[nodiscard]] std::optional<FinePoint> node(std::size_t k) const { return nodes_[k].point; }
    /// Puts a node onto the drawing, in the order of the trace with those that stand there already, and with
    /// room for those that do not yet.
    /// @param wall the line on which the wall that ends here lies; the node goes where they cross if that is
    /// near
    void place(std::size_t k, const std::optional<Line>& wall);
    void take_away(std::size_t k) {
        if (nodes_[k].stays)
            return;
        nodes_[k].point.reset();
        placed_.erase(k);
    }

    /// Gives the drawing from one node to another, without those between, with its own deviation from the
    /// trace and its arcs of circles as far as none of the two divides them. @param samples of the chain
    /// @param to_node a closed chain's first one follows the last one
    void stretch(std::size_t from_node, std::size_t to_node, const WallSamples& samples,
                 DrawnChain& drawn) const;
    /// Gives all of a closed chain, as `stretch` does, without nodes.
    void whole(const WallSamples& samples, DrawnChain& drawn) const;

  private:
    struct Standing {
        std::optional<FinePoint> point;
        Vec traced;
        std::size_t step = 0;
        std::size_t edge = 0;
        double at = 0;       ///< along the drawing from its first vertex, in cells
        bool stays = false;  ///< where it was traced
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
    std::vector<Vec> places_;  // of its vertices
    bool closed_ = false;
    CellShape shape_;
    LatticePoint origin_;
    double reach_ = 0;  // cells that a node may go from where it was traced for the sake of a wall or corner
    std::vector<Standing> nodes_;  // an open chain's with its ends
    IndexSet placed_;              // those that have a point
    std::vector<double> begins_;   // of edges along the drawing, and its whole length
};

}  // namespace d2b

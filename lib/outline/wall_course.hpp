#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "outline/wall_graph.hpp"
#include "outline/wall_shape.hpp"

namespace d2b {

/// A chain in its drawn form, with the places of the nodes that stand on it.
class Course {
  public:
    Course() = default;
    Course(DrawnChain drawn, const Chain& chain, const WallSamples& samples, const CellShape& shape);

    [[nodiscard]] const DrawnChain& drawn() const { return drawn_; }
    [[nodiscard]] std::optional<FinePoint> node(std::size_t k) const { return nodes_[k].point; }
    /// Puts a node onto the drawing, in the order of the trace with those that stand there already, and with
    /// room for those that do not yet.
    /// @param wall the line on which the wall that ends here lies; the node goes where they cross if that is
    /// near
    /// @param straight whether the drawing has walls; on a staircase a node hardly leaves the place where it
    /// was traced
    void place(std::size_t k, const std::optional<Line>& wall, bool straight);

    /// The drawing of each arc, from node to node, with its own deviation from the trace and its arcs of
    /// circles as far as no node divides them. @param samples of the chain
    [[nodiscard]] std::vector<DrawnChain> arcs(const WallSamples& samples) const;
    [[nodiscard]] double length() const { return begins_.back(); }

  private:
    struct Standing {
        std::optional<FinePoint> point;
        FinePoint traced;
        std::size_t step = 0;
        std::size_t edge = 0;
        double at = 0;  ///< along the drawing from its first vertex, in cells
    };
    [[nodiscard]] std::size_t edges() const { return begins_.size() - 1; }
    [[nodiscard]] Vec vertex(std::size_t k) const;
    [[nodiscard]] std::size_t edge_of(std::size_t step) const;
    [[nodiscard]] double wanted(const Standing& node, const std::optional<Line>& wall, double reach) const;
    void bound(std::size_t k, double& low, double& high) const;
    void stand(Standing& node, double at);
    [[nodiscard]] DrawnChain arc(std::size_t k) const;
    void match(DrawnChain& arc, std::size_t first, std::size_t last, std::size_t steps) const;
    void add_circles(DrawnChain& arc) const;

    DrawnChain drawn_;
    bool closed_ = false;
    CellShape shape_;
    LatticePoint origin_;
    std::vector<Standing> nodes_;  // an open chain's with its ends
    std::vector<double> begins_;   // of edges along the drawing, and its whole length
};

}  // namespace d2b

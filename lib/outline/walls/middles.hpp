#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "outline/walls/chain_form.hpp"
#include "outline/walls/drawn_chain.hpp"

namespace d2b {

/// Draws parts of a chain through the midpoints of its steps. These lie evenly about the line that the
/// staircase approximates and half a cell from all cell centers, so no cell changes sides.
class Middles {
  public:
    /// @param node_steps steps of the chain at which nodes may be @param samples, shape must outlive this
    /// @param tolerance largest distance in cells from the trace in all modes
    Middles(const WallSamples& samples, const CellShape& shape, LatticePoint origin,
            const std::vector<std::uint32_t>& node_steps, double tolerance);

    /// Returns true if cutting off corners stays within the tolerance; otherwise the closest mode is the
    /// trace itself.
    [[nodiscard]] static bool cuts_corners(const CellShape& shape, double tolerance) {
        return shape.longer_side() / 2 <= tolerance;
    }
    /// Appends the vertices of a stretch: from the midpoint of its first step to that of its last, or around
    /// a closed chain. @param chain the new vertices are joined to its last one, if any
    /// @param end the end of an open chain, if the stretch reaches it
    void append(const ChainForm::Stretch& stretch, const FinePoint* end, DrawnChain& chain) const;

  private:
    struct Candidate {
        Vec place;
        std::size_t step;
        bool on_corner;  // on a lattice corner; otherwise at the midpoint of the step
        bool kept;       // a node
    };
    [[nodiscard]] Vec unit(std::size_t step) const { return samples_.at(step + 1) - samples_.at(step); }
    [[nodiscard]] double turn(std::size_t step) const;
    [[nodiscard]] bool is_node(std::size_t step) const;
    [[nodiscard]] bool stays(std::size_t step, Form form) const;
    [[nodiscard]] std::vector<Candidate> candidates(const ChainForm::Stretch& stretch) const;
    [[nodiscard]] double error(const Candidate& from, const Candidate& to, double limit) const;
    void thin(std::vector<Candidate>& points, double limit) const;
    static void straighten(std::vector<Candidate>& points);

    const WallSamples& samples_;
    const CellShape& shape_;
    LatticePoint origin_;
    const std::vector<std::uint32_t>& node_steps_;
    double tolerance_;
    bool cuts_corners_;
};

}  // namespace d2b

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "outline/walls/chain_form.hpp"
#include "outline/walls/drawn_chain.hpp"

namespace d2b {

/// Draws stretches of a chain through the middles of its steps. A staircase's middles lie evenly about the
/// line that it stands for, and half a cell from the middles of all cells: none changes sides.
class Middles {
  public:
    /// @param node_steps of the chain: where others may stand @param samples, shape must outlive this
    /// @param tolerance cells: no form leaves the trace by more
    Middles(const WallSamples& samples, const CellShape& shape, LatticePoint origin,
            const std::vector<std::uint32_t>& node_steps, double tolerance);

    /// Whether corners can be cut off within the tolerance; else the closest form is the trace itself.
    [[nodiscard]] static bool cuts_corners(const CellShape& shape, double tolerance) {
        return shape.longer_side() / 2 <= tolerance;
    }
    /// Appends the vertices of a stretch: from the middle of its first step to that of its last, or a closed
    /// chain all round. @param chain its last vertex, where there is one, is the first that may be joined
    /// @param end the end of an open chain, if the stretch reaches it
    void append(const ChainForm::Stretch& stretch, const FinePoint* end, DrawnChain& chain) const;

  private:
    struct Candidate {
        Vec place;
        std::size_t step;
        bool on_corner;  // of the lattice; else in the middle of the step
        bool kept;       // where others stand
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

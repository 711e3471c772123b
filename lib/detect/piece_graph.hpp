#pragma once

#include <cstdint>
#include <vector>

#include "core/grid.hpp"
#include "detect/label_sets.hpp"

namespace d2b {

/// Pieces of buildings and their common borders; merges small pieces into their neighbours.
class PieceGraph {
  public:
    struct Border {
        Label other = 0;
        std::int64_t beside = 0;  ///< pairs of cells in one row
        std::int64_t below = 0;   ///< pairs of cells in one column
    };
    struct Piece {
        std::int64_t cells = 0;
        std::int64_t heights = 0;  ///< cells whose height is known
        double height_sum = 0;
        bool wide = false;            ///< an opening leaves something of it
        std::vector<Border> borders;  ///< each neighbour may be there more than once
    };

    PieceGraph(Label count, const CellSize& cell);
    [[nodiscard]] Piece& piece(Label label) { return pieces_[label]; }
    /// Counts a pair of neighbouring cells of two pieces.
    void add_pair(Label a, Label b, bool beside);
    /// The smallest piece goes first, of equal ones the first in scan order. Each time a border is looked at,
    /// its piece at least doubles or is done with: time O(n log n) for n borders and pieces.
    void merge_small(std::int64_t least_cells);
    /// Numbers for the labels, from 1 on, one a piece that is left.
    [[nodiscard]] std::vector<Label> numbered() { return sets_.numbered(); }

  private:
    /// Sums up what the piece shares with each neighbour.
    void tally(Label label);
    /// After tally(). @returns 0 where there is no neighbour
    [[nodiscard]] Label best_neighbour(Label label) const;
    [[nodiscard]] bool better(const Piece& of, const Border& a, const Border& b) const;
    [[nodiscard]] Label merge(Label label, Label into);

    double below_length_;  ///< of an edge between rows, where one between columns is 1
    std::vector<Piece> pieces_;
    LabelSets sets_;
    std::vector<std::size_t> place_;  ///< tally's scratch: 1 + where a neighbour is in the list, 0: nowhere
};

}  // namespace d2b

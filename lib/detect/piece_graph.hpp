#pragma once

#include <cstdint>
#include <vector>

#include "core/grid.hpp"
#include "detect/label_sets.hpp"

namespace d2b {

/// Region adjacency graph of pieces of buildings, weighted by the length of common borders. Merges small
/// pieces into their neighbours.
class PieceGraph {
  public:
    struct Border {
        Label other = 0;
        std::int64_t beside = 0;  ///< pairs of cells in one row
        std::int64_t below = 0;   ///< pairs of cells in one column
    };
    struct Piece {
        std::int64_t cells = 0;
        std::int64_t heights = 0;  ///< cells with a valid height
        double height_sum = 0;
        bool wide = false;            ///< not removed completely by an opening
        std::vector<Border> borders;  ///< may contain a neighbour more than once
    };

    PieceGraph(Label count, const CellSize& cell);
    [[nodiscard]] Piece& piece(Label label) { return pieces_[label]; }
    /// Counts a pair of neighbouring cells of two pieces.
    void add_pair(Label a, Label b, bool beside);
    /// Merges the smallest piece first; the first in scan order in case of a tie. Each time a border is
    /// visited, its piece at least doubles or vanishes, so the time is O(n log n) for n borders and pieces.
    void merge_small(std::int64_t least_cells);
    /// Returns consecutive numbers from 1 for the labels, one per remaining piece.
    [[nodiscard]] std::vector<Label> numbered() { return sets_.numbered(); }

  private:
    /// Merges duplicate borders with the same neighbour.
    void tally(Label label);
    /// Requires tally().
    /// @returns 0 if there is no neighbour
    [[nodiscard]] Label best_neighbour(Label label) const;
    [[nodiscard]] bool better(const Piece& of, const Border& a, const Border& b) const;
    [[nodiscard]] Label merge(Label label, Label into);

    double below_length_;  ///< length of an edge between rows; an edge between columns has length 1
    std::vector<Piece> pieces_;
    LabelSets sets_;
    std::vector<std::size_t> place_;  ///< scratch of tally(): 1 + index of a neighbour in the list, or 0
};

}  // namespace d2b

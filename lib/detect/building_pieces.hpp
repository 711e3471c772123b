#pragma once

#include <cstdint>
#include <vector>

#include "core/band.hpp"
#include "core/disjoint_sets.hpp"
#include "core/grid.hpp"
#include "detect/detection.hpp"
#include "raster/morphology.hpp"
#include "raster/regions.hpp"

namespace d2b::detect {

/// Region adjacency graph of pieces of buildings, weighted by the length of common borders. Merges small
/// pieces into their neighbours.
class PieceAdjacencyGraph {
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

    PieceAdjacencyGraph(Label count, const CellSize& cell);
    [[nodiscard]] Piece& piece(Label label) { return pieces_[label]; }
    /// Counts a pair of neighbouring cells of two pieces.
    void add_pair(Label a, Label b, bool beside);
    /// Merges the smallest piece first; the first in scan order in case of a tie. Each time a border is
    /// visited, its piece at least doubles or vanishes, so the time is O(n log n) for n borders and pieces.
    void merge_small(std::int64_t min_cells);
    /// Returns consecutive numbers from 1 for the labels, one per remaining piece.
    [[nodiscard]] std::vector<Label> numbered() { return sets_.numbered().of; }

  private:
    /// Merges duplicate borders with the same neighbour.
    void merge_duplicate_borders(Label label);
    /// Requires merge_duplicate_borders().
    /// @returns 0 if there is no neighbour
    [[nodiscard]] Label best_neighbour(Label label) const;
    [[nodiscard]] bool better(const Piece& of, const Border& a, const Border& b) const;
    [[nodiscard]] Label merge(Label label, Label into);

    double below_length_;  ///< length of an edge between rows; an edge between columns has length 1
    std::vector<Piece> pieces_;
    DisjointSets sets_{1};  ///< of labels; 0 is none
    std::vector<std::size_t>
        place_;  ///< scratch of merge_duplicate_borders(): 1 + index of a neighbour in the list, or 0
};

/// Turns each piece of a building into an object with the attributes of its building. Doubtful objects follow
/// as before.
/// @param regions regions that cover exactly the buildings' cells, each within one building
/// @param number new numbers of the regions' labels, from 1 on
void write_pieces(const Regions& regions, const std::vector<Label>& number, Detection& detection);

/// Returns the cells of all buildings.
[[nodiscard]] Mask building_cells(const Detection& detection);

/// Returns the label of each cell's region.
[[nodiscard]] Grid<Label> piece_grid(const Regions& regions, Executor& threads);

/// True if the element fits into the cell's piece; the border is replicated.
[[nodiscard]] bool fits(const Grid<Label>& pieces, const Element& element, std::int32_t r, std::int32_t c);

/// Adds the common borders of pieces to a graph: neighbouring cells of one building in different pieces.
void add_borders(const Grid<Label>& pieces, const Grid<Label>& buildings, PieceAdjacencyGraph& graph);

}  // namespace d2b::detect

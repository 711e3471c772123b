#pragma once

#include <cstdint>

#include "core/label.hpp"
#include "detect/detection.hpp"
#include "detect/element.hpp"
#include "detect/piece_graph.hpp"
#include "detect/regions.hpp"

namespace d2b {

/// Returns the cells of all buildings.
[[nodiscard]] Mask building_cells(const Detection& detection);

/// Returns the label of each cell's region.
[[nodiscard]] Grid<Label> piece_grid(const Regions& regions, Executor& threads);

/// True if the element fits into the cell's piece; the border is replicated.
[[nodiscard]] bool fits(const Grid<Label>& pieces, const Element& element, std::int32_t r, std::int32_t c);

/// Adds the common borders of pieces to a graph: neighbouring cells of one building in different pieces.
void add_borders(const Grid<Label>& pieces, const Grid<Label>& buildings, PieceGraph& graph);

}  // namespace d2b

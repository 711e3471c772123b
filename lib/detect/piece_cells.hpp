#pragma once

#include <cstdint>

#include "core/label.hpp"
#include "detect/detection.hpp"
#include "detect/element.hpp"
#include "detect/piece_graph.hpp"
#include "detect/regions.hpp"

namespace d2b {

/// The cells of all buildings.
[[nodiscard]] Mask building_cells(const Detection& detection);

/// The label of each cell's region.
[[nodiscard]] Grid<Label> piece_grid(const Regions& regions, Executor& threads);

/// Whether the element fits into the cell's piece; the border continues outwards.
[[nodiscard]] bool fits(const Grid<Label>& pieces, const Element& element, std::int32_t r, std::int32_t c);

/// Tells a graph where pieces touch: where neighbouring cells of one building are of two.
void add_borders(const Grid<Label>& pieces, const Grid<Label>& buildings, PieceGraph& graph);

}  // namespace d2b

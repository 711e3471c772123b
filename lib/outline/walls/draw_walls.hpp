#pragma once

#include <optional>
#include <vector>

#include "outline/walls/drawn_chain.hpp"

namespace d2b {

/// Moves the breakpoints between walls by a few steps to fit both neighbours best, and refits the walls.
void settle_ends(const WallSamples& samples, std::vector<WallPiece>& pieces);

/// End points of the drawing of an open chain.
struct ChainEnds {
    FinePoint first;
    FinePoint last;

    friend bool operator==(const ChainEnds&, const ChainEnds&) = default;
};

/// Joins walls into a polyline. Vertices are the intersections of consecutive walls; nearly parallel ones are
/// joined by a short wall.
/// @param origin first point of the trace @param ends of an open chain
[[nodiscard]] DrawnChain draw_walls(const WallSamples& samples, const WallStyle& style,
                                    const CellShape& shape, LatticePoint origin,
                                    const std::vector<WallPiece>& pieces,
                                    const std::optional<ChainEnds>& ends);

}  // namespace d2b

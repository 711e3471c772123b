#pragma once

#include <optional>
#include <vector>

#include "outline/walls/drawn_chain.hpp"

namespace d2b {

/// Moves the ends of walls by some steps to where they fit both neighbours best, and fits the walls again.
void settle_ends(const WallSamples& samples, std::vector<WallPiece>& pieces);

/// Where the drawing ends for an open chain.
struct ChainEnds {
    FinePoint first;
    FinePoint last;

    friend bool operator==(const ChainEnds&, const ChainEnds&) = default;
};

/// Lets walls meet: vertices are where neighbours intersect; where these are nearly parallel, a short wall
/// joins them.
/// @param origin the first point of the trace @param ends of an open chain
[[nodiscard]] DrawnChain draw_walls(const WallSamples& samples, const WallStyle& style,
                                    const CellShape& shape, LatticePoint origin,
                                    const std::vector<WallPiece>& pieces,
                                    const std::optional<ChainEnds>& ends);

}  // namespace d2b

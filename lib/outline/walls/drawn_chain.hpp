#pragma once

#include <cstddef>
#include <vector>

#include "core/lattice.hpp"
#include "outline/walls/wall_piece.hpp"

namespace d2b {

/// A chain as it is drawn in place of its trace.
struct DrawnChain {
    std::vector<FinePoint> vertices;  ///< an open chain's with both ends, a closed one's without repetition
    std::vector<std::size_t> steps;   ///< the step of the trace that each vertex stands for, ascending
    std::vector<CircularArc> arcs;    ///< ring 0
    double deviation = 0;             ///< cells: at least the Frechet distance, so both Hausdorff distances
};

/// Finds for each vertex the step of the trace that it stands for, and how far trace and drawing are apart at
/// most.
/// @param chain vertices are set, steps are hints
void match_trace(const WallSamples& samples, const CellShape& shape, LatticePoint origin, DrawnChain& chain);

/// How far a drawing and the stretch of the trace from its first to its last step are apart at most. What
/// lies between two steps that vertices stand for is compared with the edge between these: as one goes along
/// both at the same time, the distance is nowhere larger than at corners.
[[nodiscard]] double deviation(const WallSamples& samples, const CellShape& shape, LatticePoint origin,
                               const DrawnChain& chain, bool closed);

/// Twice the area of a closed chain, in cells; its sign is the orientation's.
[[nodiscard]] double twice_area(const WallSamples& samples);
[[nodiscard]] double twice_area(const std::vector<FinePoint>& ring, const CellShape& shape,
                                LatticePoint origin);

}  // namespace d2b

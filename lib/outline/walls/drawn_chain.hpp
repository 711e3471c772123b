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

    /// Appends a vertex, unless the last one is in its place.
    void add(FinePoint vertex, std::size_t step) {
        if (!vertices.empty() && vertices.back() == vertex)
            return;
        vertices.push_back(vertex);
        steps.push_back(step);
    }
    void remove_last() {
        vertices.pop_back();
        steps.pop_back();
    }
};

/// Finds for each vertex the step of the trace that it stands for, and how far trace and drawing are apart at
/// most.
/// @param chain vertices are set, steps are hints
void match_trace(const WallSamples& samples, const CellShape& shape, LatticePoint origin, DrawnChain& chain);

/// Calls visit(step, square) for the places at which a drawing and the stretch of the trace from its first to
/// its last step can be farthest apart, with how far they are there, in cells, squared. What lies between two
/// steps that vertices stand for is compared with the edge between these: as one goes along both at the same
/// time, the distance is nowhere larger than at corners.
template <typename Visit>
void for_distances(const WallSamples& samples, const CellShape& shape, LatticePoint origin,
                   const DrawnChain& chain, bool closed, const Visit& visit) {
    const std::size_t n = chain.vertices.size();
    Vec from = shape.from_fine(chain.vertices.front(), origin);
    for (std::size_t k = 0; k + (closed ? 0 : 1) < n; ++k) {
        const Vec to = shape.from_fine(chain.vertices[k + 1 < n ? k + 1 : 0], origin);
        const std::size_t first = chain.steps[k];
        const std::size_t last = k + 1 < n ? chain.steps[k + 1] : chain.steps.front() + samples.steps();
        visit(first, dot(from - samples.at(first), from - samples.at(first)));
        visit(last, dot(to - samples.at(last), to - samples.at(last)));
        samples.for_corners(first, last, [&](std::size_t step, Vec corner) {
            visit(step, square_distance(corner, from, to));
            return true;
        });
        from = to;
    }
}

/// The largest of these distances, in cells.
[[nodiscard]] double deviation(const WallSamples& samples, const CellShape& shape, LatticePoint origin,
                               const DrawnChain& chain, bool closed);

/// Twice the area of a closed chain, in cells; its sign is the orientation's.
[[nodiscard]] double twice_area(const WallSamples& samples);
[[nodiscard]] double twice_area(const std::vector<FinePoint>& ring, const CellShape& shape,
                                LatticePoint origin);

}  // namespace d2b

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/lattice.hpp"
#include "outline/walls/wall_segmentation.hpp"

namespace d2b::outline {

/// Polyline that replaces the trace of a chain.
struct ChainPolyline {
    std::vector<FinePoint> vertices;  ///< including both ends if open, no repetition if closed
    std::vector<std::size_t> steps;   ///< step of the trace that each vertex corresponds to, ascending
    std::vector<CircularArc> arcs;    ///< their ring is 0
    double deviation =
        0;  ///< cells; upper bound of the Frechet distance and thus of both Hausdorff distances

    /// Appends a vertex unless it equals the last one.
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

/// Calls visit(step, square) with squared distances in cells at all positions at which drawing and trace can
/// be farthest apart. Each edge is compared with the part of the trace between the steps of its vertices: if
/// both are traversed simultaneously, the distance is largest at corners.
template <typename Visit>
void for_distances(const TraceSums& samples, const ChainPolyline& chain, bool closed, const Visit& visit) {
    const std::size_t n = chain.vertices.size();
    Vec2 from = samples.from_fine(chain.vertices.front());
    for (std::size_t k = 0; k + (closed ? 0 : 1) < n; ++k) {
        const Vec2 to = samples.from_fine(chain.vertices[k + 1 < n ? k + 1 : 0]);
        const std::size_t first = chain.steps[k];
        const std::size_t last = k + 1 < n ? chain.steps[k + 1] : chain.steps.front() + samples.steps();
        visit(first, dot(from - samples.at(first), from - samples.at(first)));
        visit(last, dot(to - samples.at(last), to - samples.at(last)));
        samples.for_corners(first, last, [&](std::size_t step, Vec2 corner) {
            visit(step, square_distance(corner, from, to));
            return true;
        });
        from = to;
    }
}

/// Largest of these distances, in cells.
[[nodiscard]] double deviation(const TraceSums& samples, const ChainPolyline& chain, bool closed);

/// Twice the signed area of a closed chain, in cells.
[[nodiscard]] double twice_area(const TraceSums& samples);
/// Twice the signed area of a ring that is drawn for it.
[[nodiscard]] double twice_area(const std::vector<FinePoint>& ring, const TraceSums& samples);

/// End points of the drawing of an open chain.
struct ChainEnds {
    FinePoint first;
    FinePoint last;

    friend bool operator==(const ChainEnds&, const ChainEnds&) = default;
};

/// Joins walls into a polyline. Vertices are the intersections of consecutive walls; nearly parallel ones are
/// joined by a short wall.
/// @param ends of an open chain
[[nodiscard]] ChainPolyline draw_walls(const TraceSums& samples, const WallParameters& parameters,
                                       const std::vector<WallSegment>& segments,
                                       const std::optional<ChainEnds>& ends);

}  // namespace d2b::outline

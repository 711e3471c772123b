#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/stop_token.hpp"
#include "surface/nonmanifold_vertices.hpp"
#include "surface/planar_partition.hpp"

namespace d2b::surface {

/// Change made at a node.
struct VertexRepair {
    FinePoint place;
    FinePoint moved;      ///< new position of the moved corner
    bool filled = false;  ///< true if a notch within a building was filled, false if buildings were cut apart
    std::vector<std::int32_t> contours;  ///< around the node
};

struct ResolvedVertices {
    std::vector<VertexRepair> repairs;
    std::vector<std::uint32_t> unresolved;  ///< contours at nodes without room for a move; ascending
};

/// Resolves non-manifold vertices: changes a plan until every vertical edge has at most two walls, for all
/// buildings together and for each one alone, and no face touches itself. A run of sectors is moved off the
/// node and connected to it by an edge. The distance is the minimum gap, or as little more as a sharp angle
/// needs. If more is wanted, the largest distance that fits and is allowed is used; if there is no room for
/// the minimum gap, a smaller one.
///
///                       A and C are high,                   or, if A and C are of
///          A | B        B and D are low:           A | B    one building, a corner      A \ B
///         ---+---       a corner of C            ---+       of B moves, which fills    ---+ +---
///          D | C        moves                      D \ +--- the notch between them      D | C
///                                                     | C
///
/// Moves pass over no other vertices, so the plan stays planar; exact. If possible, a corner is not moved
/// close to others.
/// @throws Cancelled
[[nodiscard]] ResolvedVertices resolve_nonmanifold_vertices(PlanarPartition& plan,
                                                            std::span<const PartitionContour> contours,
                                                            const MoveDistances& wanted = {},
                                                            const StopToken& stop = {});

}  // namespace d2b::surface

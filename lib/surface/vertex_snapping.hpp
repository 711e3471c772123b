#pragma once

#include <cstdint>
#include <vector>

#include "surface/planar_partition.hpp"

namespace d2b::surface {

/// Repairs outlines after rounding to a lattice: a vertex close to an edge may have moved to its other side,
/// so that outlines cross by less than a step. While contours conflict, routes every edge through all
/// vertices within a step of it, for a limited number of rounds. Vertices do not move, and common walls stay
/// common. Related to iterated snap rounding (Halperin and Packer 2002).
void snap_round(std::vector<PartitionContour>& contours);

/// Routes every edge once through all vertices within a step of it, so that outlines that meet share
/// vertices.
void route_through_vertices(std::vector<PartitionContour>& contours);

/// Merges nodes closer than a gap, if nothing lies between them, because programs that read solids merge them
/// and then find broken faces. The plan stays planar; exact.
void merge_near_nodes(PlanarPartition& plan, const LatticeDistance& gap);

/// Raises roofs that share a node to the higher one if they differ by less than a gap, because the corners of
/// such a low wall would be merged by readers.
void level_near_roofs(const PlanarPartition& plan, std::vector<PartitionContour>& contours, std::int64_t gap);

}  // namespace d2b::surface

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/stop_token.hpp"
#include "surface/planar_partition.hpp"

namespace d2b::surface {

/// Consecutive sectors around a node, counter-clockwise. Sector i is on the left of arm i.
struct SectorRun {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// Returns the arms that bound the sectors of a run: count + 1. @param all around the node
[[nodiscard]] std::vector<IncidentEdge> bounding_half_edges(const std::vector<IncidentEdge>& all,
                                                            const SectorRun& run);

/// Options for resolving a non-manifold vertex: any of the runs may be moved off the node.
struct NonmanifoldVertex {
    bool fills = false;  ///< true if the runs are notches within a building, false if they are parts that
                         ///< rise above the rest
    std::vector<SectorRun> runs;  ///< at least one
};

/// Finds the lowest height at which the vertical line over a node is a non-manifold edge, with more than two
/// walls: there, the solid occupies more than one run of sectors, for all buildings together or for a single
/// one, because each has a solid of its own. A roof that touches itself counts, too, because few programs can
/// triangulate its polygon. @param arms around the node, counter-clockwise @return the first one found
[[nodiscard]] std::optional<NonmanifoldVertex> find_nonmanifold(FinePoint node,
                                                                const std::vector<IncidentEdge>& arms,
                                                                std::span<const PartitionContour> contours);

/// Distances by which touching corners are moved apart.
struct MoveDistances {
    using Contours = std::span<const std::int32_t>;
    std::int64_t steps = 0;   ///< wanted distance, if more than the minimum gap
    GapTolerances gaps = {};  ///< minimum distance of a move
    /// Returns true if a move may change this area of the contours around it, in square steps: next to open
    /// ground, and between contours. A smaller area is allowed as well. Empty: always. Not called for minimal
    /// moves.
    std::function<bool(Contours contours, double outside, double inside)> allows = {};
    /// Called for every move, including minimal ones.
    std::function<void(Contours contours, double outside)> take = {};
};

/// Area swept by moving edges, in square steps.
struct SweptArea {
    double outside = 0;  ///< by edges next to open ground
    double inside = 0;   ///< by edges between contours

    /// Adds an edge with one moving end. @param beside the contours on both sides of the edge
    void add(const IncidentEdge& beside, FinePoint end, FinePoint from, FinePoint to);
};

/// Returns the distinct contours around a node.
[[nodiscard]] std::vector<std::int32_t> contours_of(const std::vector<IncidentEdge>& arms);

/// Returns the angle counter-clockwise from east, y up.
[[nodiscard]] double angle_of(FinePoint from, FinePoint to);
/// Returns the angle from a to b, in (0, 2 pi], counter-clockwise.
[[nodiscard]] double turned_from(double a, double b);

/// Returns decreasing distances to try, from `wanted` on; all exceed the minimum gap.
[[nodiscard]] std::vector<std::int64_t> distances_down_from(std::int64_t wanted,
                                                            const LatticeDistance& pinch);

/// Planned distance by position of the vertex; 0 if only a minimal move is allowed.
using PlannedDistances = std::map<FinePoint, std::int64_t>;

/// Chooses distances for the corners of a plan. Splits long edges near corners that will move, so that only
/// the corner is cut off, instead of a whole wall moving.
[[nodiscard]] PlannedDistances plan_distances(PlanarPartition& plan,
                                              std::span<const PartitionContour> contours,
                                              const MoveDistances& wanted, const StopToken& stop);

}  // namespace d2b::surface

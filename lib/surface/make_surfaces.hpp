#pragma once

#include <cstdint>
#include <vector>

#include "core/stop_token.hpp"
#include "dem2buildings/surfaces.hpp"
#include "surface/faces.hpp"
#include "surface/planar_partition.hpp"
#include "surface/resolve_nonmanifold.hpp"

namespace d2b::surface {

/// Building of a cluster: its id and base height in steps.
struct ClusterBuilding {
    std::int64_t id = 0;
    std::int64_t base = 0;
};

/// Contours that may touch each other but no contour outside the cluster, with the buildings that they belong
/// to.
struct SurfaceCluster {
    std::vector<PartitionContour> contours;  ///< parents before children
    std::vector<ClusterBuilding> buildings;  ///< ascending ids
};

/// Requested kinds of surfaces.
struct SurfaceForms {
    bool solids = false;
    bool shell = false;
    std::int64_t move_steps =
        0;  ///< distance by which touching corners are moved apart, if more than the minimum gap
    GapTolerances gaps = {};
};

/// Surfaces of a cluster. Solids and the blocks of the shell are ordered by their first building.
struct MadeSurfaces {
    std::vector<SurfacePart> solids;     ///< one per building
    std::vector<SurfacePart> shell;      ///< one per block of touching buildings
    std::vector<VertexRepair> repairs;   ///< their contours are those of the cluster
    std::vector<std::int64_t> left_out;  ///< ascending ids of buildings for which no valid surface was found
};

/// Makes closed surfaces of a cluster of buildings:
///
///     planar partition -> merge near nodes -> resolve non-manifold vertices -> blocks, or buildings
///       -> roofs, walls and grounds -> triangles
///
/// A building stands at its base, a block of buildings with common walls at their lowest base. Buildings that
/// do not rise above their base have no surface. Buildings that prevent a closed surface are left out, and
/// the rest is made again without them.
/// @param triangulate used for the shell only @throws Cancelled
[[nodiscard]] MadeSurfaces make_surfaces(const SurfaceCluster& cluster, const SurfaceForms& forms,
                                         const Triangulate& triangulate, const StopToken& stop = {});

}  // namespace d2b::surface

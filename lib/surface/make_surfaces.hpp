#pragma once

#include <cstdint>
#include <vector>

#include "core/stop_request.hpp"
#include "dem2buildings/surfaces.hpp"
#include "surface/plan.hpp"
#include "surface/take_apart_pinches.hpp"
#include "surface/triangulate.hpp"

namespace d2b {

/// A building of a cluster: its number and the height that it stands at, in steps.
struct PlanBuilding {
    std::int64_t id = 0;
    std::int64_t base = 0;
};

/// Contours that may touch each other, and nothing else; heights of those that stand on a building.
struct SurfaceCluster {
    std::vector<PlanContour> contours;    ///< parents before what stands on them
    std::vector<PlanBuilding> buildings;  ///< ascending ids
};

/// Which surfaces are asked for.
struct SurfaceForms {
    bool solids = false;
    bool shell = false;
    std::int64_t pinch_steps = 0;  ///< that touching corners are moved by, where more than the gap is wanted
    PlanGaps gaps = {};
};

/// The surfaces of a cluster. The shell's blocks come by their first buildings, and so do solids.
struct MadeSurfaces {
    std::vector<SurfacePart> solids;  ///< a building each
    std::vector<SurfacePart> shell;   ///< a block of touching buildings each
    std::vector<PinchMend> mends;     ///< their contours are those of the cluster
    std::vector<std::int64_t>
        left_out;  ///< ids of buildings that could not be brought into either; ascending
};

/// planar partition -> near corners made one -> pinches taken apart -> blocks, or buildings -> roofs, walls
/// and grounds -> triangles
///
/// A building stands at its base, a block of buildings that share a wall at the lowest base of them. Where
/// nothing stands above its building's base there is no surface. What is in the way of a closed surface is
/// left out, and the rest is made as if it were not there.
/// @param triangulate of the shell alone @throws Cancelled
[[nodiscard]] MadeSurfaces make_surfaces(const SurfaceCluster& cluster, const SurfaceForms& forms,
                                         const Triangulate& triangulate, const StopRequest& stop = {});

}  // namespace d2b

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surface/make_surfaces.hpp"

namespace d2b::surface {

/// Neighbouring roofs, or a tier and the roof that it stands on, whose height difference is too small.
struct RoofStep {
    std::array<std::int32_t, 2> contours{};  ///< indices into the cluster
    FinePoint place;                         ///< on the wall between them
    std::int64_t before = 0;                 ///< height difference before, in steps of height
    std::int64_t after = 0;                  ///< height difference after; 0 if they are one roof now
};

/// Merges neighbouring roofs whose heights differ by less than `least`, smallest difference first. The merged
/// roof gets the area-weighted mean height, so that the volume is preserved. The total volume moved in a
/// block of touching roofs is limited to a share of its volume; merges beyond that are skipped. @param
/// cluster whose tops change; unchanged if its contours conflict @param least smallest height difference, in
/// steps of height @return all differences that were too small, in the order of the plan's edges
[[nodiscard]] std::vector<RoofStep> level_roofs(SurfaceCluster& cluster, std::int64_t least);

}  // namespace d2b::surface

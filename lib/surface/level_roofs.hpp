#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surface/make_surfaces.hpp"

namespace d2b {

/// Two roofs beside each other, or a tier and what it stands on, that differ by less than they should.
struct RoofStep {
    std::array<std::int32_t, 2> contours{};  ///< of the cluster
    FinePoint place;                         ///< on the wall between them
    std::int64_t before = 0;                 ///< steps of height
    std::int64_t after = 0;                  ///< likewise; 0 where they are one roof now
};

/// Makes roofs beside each other that differ by less than a height one roof, at the mean of their heights
/// weighted by area, so that together they hold what they held; the lowest steps first. All that moves in a
/// block of touching roofs comes to no more than a share of its volume: what would take more stays.
/// @param cluster whose tops change; one whose contours are at odds stays as it is
/// @param least height of a step, in steps of height
/// @return all steps that were lower, in the order of the plan's edges
[[nodiscard]] std::vector<RoofStep> level_roofs(SurfaceCluster& cluster, std::int64_t least);

}  // namespace d2b

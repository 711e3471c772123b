#pragma once

#include <cstdint>
#include <vector>

#include "detect/regions.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// A smooth piece of the surface: of a roof, or by chance of a crown.
struct SmoothSegment {
    std::int64_t cells = 0;
    double tilt = 0;  ///< rise over run of the plane that fits it best
};

struct SmoothSegments {
    Regions regions;
    std::vector<SmoothSegment> pieces;  ///< by label - 1
};

/// Regions of cells across which the surface hardly bends, large enough to be seen as such.
/// @param flags of smoothness()
[[nodiscard]] Regions smooth_regions(const Scene& scene, const Mask& cells, const Grid<std::uint8_t>& flags,
                                     Executor& threads);

/// Joins elevated neighbours across which the surface hardly bends, and keeps the pieces that are large
/// enough to be seen as such. Roofs are few large pieces, crowns shatter.
/// @param flags of smoothness()
[[nodiscard]] SmoothSegments smooth_segments(const Scene& scene, const Mask& elevated,
                                             const Grid<std::uint8_t>& flags, Executor& threads);

}  // namespace d2b

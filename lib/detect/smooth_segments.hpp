#pragma once

#include <cstdint>
#include <vector>

#include "detect/regions.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Smooth segment of the surface: part of a roof, or by chance of a crown.
struct SmoothSegment {
    std::int64_t cells = 0;
    double tilt = 0;  ///< slope (rise over run) of its least-squares plane
};

struct SmoothSegments {
    Regions regions;
    std::vector<SmoothSegment> pieces;  ///< by label - 1
};

/// Labels regions of cells across which the surface hardly bends, and drops those too small to be
/// significant.
/// @param flags result of smoothness()
[[nodiscard]] Regions smooth_regions(const Scene& scene, const Mask& cells, const Grid<std::uint8_t>& flags,
                                     Executor& threads);

/// Segments the elevated cells into smooth regions, and drops those too small to be significant. Roofs form
/// few large segments, crowns many small ones.
/// @param flags result of smoothness()
[[nodiscard]] SmoothSegments smooth_segments(const Scene& scene, const Mask& elevated,
                                             const Grid<std::uint8_t>& flags, Executor& threads);

}  // namespace d2b

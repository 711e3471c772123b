#pragma once

#include <optional>

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "detect/scene.hpp"

namespace d2b::detect {

/// Sampling of sloping roofs. A cell has the height of a point anywhere in it, so that a plane of slope s
/// looks rough by s times a part of the cell: by 0.29 of it for one point per cell, and by less for the
/// highest of many. Unlike the share of filled cells, this shows the density of points in any raster.
struct SlopeSampling {
    double error_m = 0;       ///< most frequent standard deviation from a plane, per unit of slope
    double planar_share = 0;  ///< share of the windows that are no rougher than planes of one point per cell
};

/// Fits planes to windows of 3 by 3 cells within roofs, and counts those with slopes of 0.3 to 0.9. Integer
/// counts, so the order does not matter. Returns nullopt if there are fewer than 200 such windows. Halo: one
/// cell.
[[nodiscard]] std::optional<SlopeSampling> slope_sampling(const Scene& scene, const Mask& roofs,
                                                          Executor& threads);

}  // namespace d2b::detect

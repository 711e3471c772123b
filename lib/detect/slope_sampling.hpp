#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/executor.hpp"
#include "core/grid.hpp"
#include "detect/scene.hpp"
#include "detect/surface_quality.hpp"

namespace d2b::detect {

/// Sampling of sloping roofs. A cell has the height of a point anywhere in it, so that a plane of slope s
/// looks rough by s times a part of the cell: by 0.29 of it for one point per cell, and by less for the
/// highest of many. Unlike the share of filled cells, this shows the density of points in any raster.
struct SlopeSampling {
    double error_m = 0;       ///< most frequent standard deviation from a plane, per unit of slope
    double planar_share = 0;  ///< share of the windows that are no rougher than planes of one point per cell
};

/// Deviations of sloping roofs from planes. Integer counts, so the order does not matter.
struct SlopeErrors {
    static constexpr std::size_t bins = 60;

    Histogram<bins> errors;   ///< of windows, in steps of 0.02 m per unit of slope
    std::int64_t planar = 0;  ///< windows that are no rougher than planes of one point per cell

    void merge(const SlopeErrors& other) {
        errors.merge(other.errors);
        planar += other.planar;
    }
    /// Returns nullopt if there are fewer than 200 windows.
    [[nodiscard]] std::optional<SlopeSampling> sampling() const;
};

/// Fits planes to windows of 3 by 3 cells within roofs, and counts those with slopes of 0.3 to 0.9. Halo: one
/// cell.
[[nodiscard]] SlopeErrors slope_errors(const Scene& scene, const Mask& roofs, Executor& threads);

}  // namespace d2b::detect

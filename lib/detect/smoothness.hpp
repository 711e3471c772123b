#pragma once

#include <algorithm>
#include <cstdint>

#include "detect/scene.hpp"

namespace d2b {

/// Curvature of the surface at a cell, as bits: second differences below thresholds. Thresholds grow with the
/// cell size, because the relief of roofs and the error of gridding do, and with noise beyond the usual.
enum Smooth : std::uint8_t {
    smooth_along_row = 1,     ///< straight along the row: a plane, or a roof that slopes across the row
    smooth_along_column = 2,  ///< same along the column
    smooth_any_way =
        4,  ///< straight along the row, the column or a diagonal: planes of any orientation, and edges
    smooth_enough = 8,  ///< straight along row or column, by the threshold used for whole objects
};

/// Quality of the surface as estimated from the data, which determines the thresholds of smoothness.
struct SurfaceQuality {
    double noise = 0;       ///< standard deviation of the surface's noise, metres
    double filled = 0;      ///< share of cells without a pulse, see filled_share()
    double strictness = 1;  ///< threshold scale for clean data, see roof_strictness()
    double allowance = 1;   ///< factor on the margin added for sparse points
    /// Step in m to which elevations were rounded, if it is so coarse that cells of a crown are equal and
    /// those of a slope are not; else 0.
    double rounded_to = 0;

    /// Share of cells whose smoothness is no evidence. Rounded elevations are treated like sparse points.
    [[nodiscard]] double unseen() const { return rounded_to > 0 ? std::max(filled, 0.08) : filled; }
};

/// Thresholds of second differences in m.
struct SmoothLimits {
    float line;
    float any;
    float enough;

    friend bool operator==(const SmoothLimits&, const SmoothLimits&) = default;
};
/// @param side cell size in m
[[nodiscard]] SmoothLimits smooth_limits(double side, const SurfaceQuality& quality);

/// Computes one byte of flags per cell. Halo: one row and column; the border is replicated. A cell without
/// data is smooth in no direction, its neighbours in none that crosses it.
[[nodiscard]] Grid<std::uint8_t> smoothness(const MetreGrid& surface, const SmoothLimits& limits,
                                            Executor& threads);

}  // namespace d2b

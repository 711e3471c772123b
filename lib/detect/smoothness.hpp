#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "detect/sampling_rules.hpp"
#include "detect/scene.hpp"
#include "raster/regions.hpp"

namespace d2b::detect {

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
    double noise = 0;            ///< standard deviation of the surface's noise, metres
    double filled = 0;           ///< share of cells without a pulse, see interpolated_fraction()
    double threshold_scale = 1;  ///< threshold scale for clean data, see estimate_threshold_scale()
    double margin_scale = 1;     ///< factor on the margin added for sparse points
    /// Step in m to which elevations were rounded, if it is so coarse that cells of a crown are equal and
    /// those of a slope are not; else 0.
    double rounded_to = 0;

    /// Share of cells whose smoothness is no evidence. Rounded elevations are treated like sparse points.
    [[nodiscard]] double uninformative_share() const {
        return rounded_to > 0 ? std::max(filled, sparse_share()) : filled;
    }
};

/// Thresholds of second differences in m.
struct SmoothnessThresholds {
    float line;
    float any;
    float enough;

    friend bool operator==(const SmoothnessThresholds&, const SmoothnessThresholds&) = default;
};
/// @param side cell size in m
[[nodiscard]] SmoothnessThresholds smoothness_thresholds(double side, const SurfaceQuality& quality);

/// Computes one byte of flags per cell. Halo: one row and column; the border is replicated. A cell without
/// data is smooth in no direction, its neighbours in none that crosses it.
[[nodiscard]] Grid<std::uint8_t> smoothness(const MetreGrid& surface, const SmoothnessThresholds& limits,
                                            Executor& threads);

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

}  // namespace d2b::detect

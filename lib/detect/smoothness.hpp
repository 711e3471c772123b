#pragma once

#include <algorithm>
#include <cstdint>

#include "detect/scene.hpp"

namespace d2b {

/// How the surface bends at a cell, as bits: second differences against thresholds that grow with the size of
/// the cells, since a roof's own relief and the error of gridding do, and with noise beyond what those cover.
enum Smooth : std::uint8_t {
    smooth_along_row =
        1,  ///< hardly any bend along the row: a roof's plane, or one with its fall line across
    smooth_along_column = 2,  ///< the same along the column
    smooth_any_way = 4,       ///< along the row, the column or a diagonal: planes of any direction, edges too
    smooth_enough = 8,        ///< along row or column, with a threshold that suits whole objects
};

/// What the data themselves say of how smooth a roof may look.
struct SurfaceQuality {
    double noise = 0;       ///< standard deviation of the surface's noise, metres
    double filled = 0;      ///< share of the cells that no pulse met, see filled_share()
    double strictness = 1;  ///< factor on the limits of clean data, see roof_strictness()
    double allowance = 1;   ///< factor on what is added to them for thin points
    /// The step that elevations were rounded to, metres, where that is so coarse that cells of a crown are
    /// equal and those of a slope are not; else 0.
    double rounded_to = 0;

    /// Share of the cells whose smoothness says nothing: where elevations are rounded, as many as where
    /// points are thin.
    [[nodiscard]] double unseen() const { return rounded_to > 0 ? std::max(filled, 0.08) : filled; }
};

/// Second differences below these are smooth, metres.
struct SmoothLimits {
    float line;
    float any;
    float enough;

    friend bool operator==(const SmoothLimits&, const SmoothLimits&) = default;
};
/// @param side of the cells, metres
[[nodiscard]] SmoothLimits smooth_limits(double side, const SurfaceQuality& quality);

/// One byte a cell. Halo: one row and column; the border continues outwards. A cell that is not valid is
/// smooth in no direction, its neighbours in none that meets it.
[[nodiscard]] Grid<std::uint8_t> smoothness(const MetreGrid& surface, const SmoothLimits& limits,
                                            Executor& threads);

}  // namespace d2b

#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "fill_gaps.hpp"
#include "render.hpp"
#include "scene.hpp"

namespace d2b::sample {

/// How a place is measured and made into a raster: pulses that come down on it, the highest return of each
/// cell, gaps, smoothing, rounding.
struct Survey {
    std::string_view name;
    double cell = 1;     ///< metres
    double pulses = 4;   ///< a square metre, as they are sent; 0: the surface itself at the middles of cells
    double kept = 1;     ///< share of the pulses that thinning leaves, drawn at random
    double beam = 0.15;  ///< radius of a pulse on a roof, metres: the first thing that it touches returns it
    double range_noise = 0.03;  ///< standard deviation of an elevation, metres
    double fill_reach = 1.5;    ///< cells without a return are filled from so many cells around
    GapFilling filling = GapFilling::nearest;
    double blur = 0;             ///< standard deviation of a Gaussian over the surface, metres
    double step = 1.0 / 64;      ///< elevations are multiples of this many metres
    bool heights_alone = false;  ///< it is the heights above ground that are multiples of the step
};

/// The surveys by which scenes are seen: dense and thin scanners, thinned clouds, stereo of satellites.
[[nodiscard]] std::span<const Survey> surveys();

/// A raster of a place; NaN where no elevation is known.
struct Seen {
    Grid grid;
    std::vector<float> elevations;  ///< metres, row by row
};

/// A scene as a survey has it.
/// @param grid of the survey's cells
[[nodiscard]] Seen see(const Scene& scene, const Grid& grid, const Survey& survey);

}  // namespace d2b::sample

#include "detect/smoothness.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/processors.hpp"
#include "core/row_bands.hpp"

namespace d2b {
namespace {

// The thresholds include noise up to this. Noise beyond it makes second differences 2.4 times as wide; crowns
// remain separable with less than that.
constexpr double usual_noise_m = 0.07;
constexpr double noise_factor = 1.5;

// If pulses are sparse, a cell has the height of a point anywhere in it or next to it, which on a slope is
// wrong by a fraction of the cell. Every survey has some cells without a pulse; the thresholds allow for this
// share.
constexpr double usual_filled = 0.02;
constexpr double sampling_factor = 0.17;

double noise_room(double noise) {
    return noise_factor * std::max(0.0, noise - usual_noise_m);
}

double sampling_room(double filled, double side) {
    return sampling_factor * side * std::sqrt(std::max(0.0, filled - usual_filled));
}

// The step along a diagonal is longer, so that the same curvature bends twice as much, but noise does not: a
// compromise.
constexpr float diagonal = 1.0F / 1.5F;

float bend(float a, float middle, float b) {
    return std::abs(a + b - 2 * middle);
}

/// 0 for NaN, because unknown heights give no evidence of smoothness.
int bit_below(float value, float limit, int bit) {
    return value < limit ? bit : 0;
}

/// Branch-free, so that the loop vectorises.
std::uint8_t flags(float row, float column, float falling, float rising, const SmoothLimits& t) {
    const int along =
        bit_below(row, t.line, smooth_along_row) | bit_below(column, t.line, smooth_along_column);
    const int any = bit_below(row, t.any, smooth_any_way) | bit_below(column, t.any, smooth_any_way) |
                    bit_below(falling * diagonal, t.any, smooth_any_way) |
                    bit_below(rising * diagonal, t.any, smooth_any_way);
    const int enough = bit_below(row, t.enough, smooth_enough) | bit_below(column, t.enough, smooth_enough);
    return static_cast<std::uint8_t>(along | any | enough);
}

D2B_FOR_EACH_PROCESSOR void flag_row(const MetreGrid& surface, std::int32_t r, const SmoothLimits& limits,
                                     std::span<std::uint8_t> out) {
    const std::span<const float> up = surface.row(std::max(r - 1, 0));
    const std::span<const float> here = surface.row(r);
    const std::span<const float> down = surface.row(std::min(r + 1, surface.rows - 1));
    const auto at = [&](std::size_t west, std::size_t c, std::size_t east) {
        const float z = here[c];
        out[c] = flags(bend(here[west], z, here[east]), bend(up[c], z, down[c]),
                       bend(up[west], z, down[east]), bend(down[west], z, up[east]), limits);
    };
    if (out.empty())
        return;
    const std::size_t last = out.size() - 1;
    at(0, 0, std::min<std::size_t>(1, last));
    for (std::size_t c = 1; c < last; ++c)
        at(c - 1, c, c + 1);
    if (last > 0)
        at(last - 1, last, last);
}

}  // namespace

SmoothLimits smooth_limits(double side, const SurfaceQuality& quality) {
    const double room = noise_room(quality.noise) + quality.allowance * sampling_room(quality.filled, side);
    // Metres, and metres per metre of cell size. Fitted on cities with cells of 0.5 to 5 m, see
    // docs/accuracy.md.
    const auto limit = [&](double metres, double of_side) {
        return static_cast<float>(quality.strictness * (metres + of_side * side) + room);
    };
    return {limit(0.06, 0.06), limit(0.10, 0.08), limit(0.13, 0.12)};
}

Grid<std::uint8_t> smoothness(const MetreGrid& surface, const SmoothLimits& limits, Executor& threads) {
    auto result = Grid<std::uint8_t>::unset(surface.rows, surface.cols, threads);
    for_row_bands(threads, surface.rows, surface.cols, [&](RowBand band) {
        for (std::int32_t r = band.begin; r < band.end; ++r)
            flag_row(surface, r, limits, result.row(r));
    });
    return result;
}

}  // namespace d2b

#include "detect/smoothness.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/row_bands.hpp"

namespace d2b {
namespace {

// Noise up to this is in the thresholds already. Beyond it a second difference is 2.4 times as wide; crowns
// keep their distance with less than that.
constexpr double usual_noise_m = 0.07;
constexpr double noise_factor = 1.5;

// Metres, and metres a metre of cell. Found on cities of 0.5 to 5 m cells, see docs/accuracy.md.
struct Thresholds {
    Thresholds(double side, double noise)
        : line(static_cast<float>(0.06 + 0.06 * side + more(noise))),
          any(static_cast<float>(0.10 + 0.08 * side + more(noise))),
          enough(static_cast<float>(0.13 + 0.12 * side + more(noise))) {}
    static double more(double noise) { return noise_factor * std::max(0.0, noise - usual_noise_m); }
    float line;
    float any;
    float enough;
};

// A diagonal's step is longer, so the same curvature bends it twice as much and the same noise as much:
// between.
constexpr float diagonal = 1.0F / 1.5F;

float bend(float a, float middle, float b) {
    return std::abs(a + b - 2 * middle);
}

/// False for NaN: a cell is smooth only by what is known.
int bit_below(float value, float limit, int bit) {
    return value < limit ? bit : 0;
}

/// Nothing branches, so that several cells are done at once.
std::uint8_t flags(float row, float column, float falling, float rising, const Thresholds& t) {
    const int along =
        bit_below(row, t.line, smooth_along_row) | bit_below(column, t.line, smooth_along_column);
    const int any = bit_below(row, t.any, smooth_any_way) | bit_below(column, t.any, smooth_any_way) |
                    bit_below(falling * diagonal, t.any, smooth_any_way) |
                    bit_below(rising * diagonal, t.any, smooth_any_way);
    const int enough = bit_below(row, t.enough, smooth_enough) | bit_below(column, t.enough, smooth_enough);
    return static_cast<std::uint8_t>(along | any | enough);
}

void flag_row(const MetreGrid& surface, std::int32_t r, const Thresholds& thresholds,
              std::span<std::uint8_t> out) {
    const std::span<const float> up = surface.row(std::max(r - 1, 0));
    const std::span<const float> here = surface.row(r);
    const std::span<const float> down = surface.row(std::min(r + 1, surface.rows - 1));
    const auto at = [&](std::size_t west, std::size_t c, std::size_t east) {
        const float z = here[c];
        out[c] = flags(bend(here[west], z, here[east]), bend(up[c], z, down[c]),
                       bend(up[west], z, down[east]), bend(down[west], z, up[east]), thresholds);
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

Grid<std::uint8_t> smoothness(const MetreGrid& surface, double side, double noise, Executor& threads) {
    const Thresholds thresholds(side, noise);
    Grid<std::uint8_t> result(surface.rows, surface.cols, 0, threads);
    for_row_bands(threads, surface.rows, surface.cols, [&](RowBand band) {
        for (std::int32_t r = band.begin; r < band.end; ++r)
            flag_row(surface, r, thresholds, result.row(r));
    });
    return result;
}

}  // namespace d2b

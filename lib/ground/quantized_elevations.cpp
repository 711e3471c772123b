#include "ground/quantized_elevations.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/grid.hpp"
#include "raster/rank_filter.hpp"

namespace d2b::ground {
namespace {

constexpr std::int32_t most = 32766;
constexpr std::int32_t near_range = 1
                                    << 14;  // steps; a power of two, so that a bit mask replaces comparisons
constexpr std::int32_t farthest_step = 1638400;  // at this magnitude, floats still resolve a tenth of a step
constexpr float max_magnitude = 1 << 30;         // steps; larger magnitudes are clamped to this
constexpr std::int16_t none = no_value_of<std::int16_t>;

/// Elevation range; inverted if empty.
struct Range {
    float lowest = no_value;
    float highest = -no_value;
    bool gaps = false;
};

/// Extends the range. Uses independent lanes, so that the loop is vectorised.
D2B_MULTIVERSION void widen(Range& range, std::span<const float> metres) {
    constexpr std::size_t lanes = 16;
    std::array<float, lanes> lowest{};
    std::array<float, lanes> highest{};
    std::array<std::int32_t, lanes> gaps{};
    lowest.fill(range.lowest);
    highest.fill(range.highest);
    const auto update = [&](float z, std::size_t lane) {
        const float known = z == no_value ? -no_value : z;
        lowest[lane] = z < lowest[lane] ? z : lowest[lane];
        highest[lane] = known > highest[lane] ? known : highest[lane];
        gaps[lane] |= z == no_value ? 1 : 0;
    };
    std::size_t i = 0;
    for (; i + lanes <= metres.size(); i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane)
            update(metres[i + lane], lane);
    for (; i < metres.size(); ++i)
        update(metres[i], 0);
    const bool any = std::ranges::any_of(gaps, [](std::int32_t gap) { return gap != 0; });
    range = {std::ranges::min(lowest), std::ranges::max(highest), range.gaps || any};
}

constexpr auto no_value_bits = std::bit_cast<std::int32_t>(no_value);

/// Branch-free, because the compiler would turn the condition into a branch and not vectorise the loop.
constexpr std::int32_t all_bits_if(bool holds) {
    return -static_cast<std::int32_t>(holds);
}

/// Returns the nearest float, which is usually the value in a file written with as many digits.
float metres_of(std::int32_t steps, float steps_per_metre) {
    return static_cast<float>(steps) / steps_per_metre;
}

/// Reasons for a row not to be representable.
struct QuantizationDefects {
    std::int32_t inexact = 0;       ///< not 0 if a value is not exactly a whole number of steps; -0 is not
    std::int32_t out_of_range = 0;  ///< not 0 if a value is too far from the base
    std::int32_t gaps = 0;
};

D2B_MULTIVERSION void quantize_row(std::span<const float> metres, std::int32_t base,
                                   std::int32_t steps_per_metre, std::int16_t* values,
                                   QuantizationDefects& defects) {
    // Adding and subtracting it rounds to a whole number, because no bits are left for fractions. For whole
    // steps within the limit, floats are accurate to a fifth of a step.
    constexpr float rounder = 12582912.0F;  // 1.5 * 2^23
    const auto steps_per_m = static_cast<float>(steps_per_metre);
    QuantizationDefects here = defects;
    for (std::size_t j = 0; j < metres.size(); ++j) {
        const auto bits = std::bit_cast<std::int32_t>(metres[j]);
        const std::int32_t known = all_bits_if(bits != no_value_bits);
        const float whole = (std::bit_cast<float>(bits & known) * steps_per_m + rounder) - rounder;
        const float above = whole > -max_magnitude ? whole : -max_magnitude;
        const auto steps = static_cast<std::int32_t>(above < max_magnitude ? above : max_magnitude);
        const std::int32_t from_base = (steps - base) & known;
        here.inexact |= std::bit_cast<std::int32_t>(metres_of(steps, steps_per_m)) ^ (bits & known);
        here.out_of_range |= (from_base + near_range) & ~(2 * near_range - 1);
        here.gaps |= ~known;
        values[j] = static_cast<std::int16_t>(from_base | (none & ~known));
    }
    defects = here;
}

/// Returns the cells of a row of a tile. @param i from the tile's first row
std::span<const float> row_of(const MetreGrid& grid, const Tile& place, std::int32_t i) {
    return grid.row(place.row + i)
        .subspan(static_cast<std::size_t>(place.col), static_cast<std::size_t>(place.cols));
}

}  // namespace

/// Converts in one pass, which works almost everywhere: whole centimetres near that of one cell.
bool QuantizedElevations::quantize_near(float metre, const MetreGrid& metres, const Tile& place) {
    steps_per_metre = 100;
    const double steps = std::round(static_cast<double>(metre) * steps_per_metre);
    if (!(std::abs(steps) < farthest_step - near_range))
        return false;
    base = static_cast<std::int32_t>(steps);
    QuantizationDefects defects;
    for (std::int32_t i = 0; i < place.rows; ++i) {
        quantize_row(row_of(metres, place, i), base, steps_per_metre, surface.row(i).data(), defects);
        if (defects.inexact != 0 || defects.out_of_range != 0)
            return false;
    }
    gaps = defects.gaps != 0;
    return true;
}

bool QuantizedElevations::take(const MetreGrid& metres, const Tile& place) {
    surface.rows = place.rows;
    surface.cols = place.cols;
    surface.values.resize(surface.index(place.rows, 0));
    if (quantize_near(metres.at(place.row + place.rows / 2, place.col + place.cols / 2), metres, place))
        return true;
    Range range;
    for (std::int32_t i = 0; i < place.rows; ++i)
        widen(range, row_of(metres, place, i));
    gaps = range.gaps;
    const auto lowest = static_cast<double>(std::min(range.lowest, range.highest));
    const auto highest = static_cast<double>(std::max(range.lowest, range.highest));
    const auto quantize_all = [&] {
        QuantizationDefects defects;
        for (std::int32_t i = 0; i < place.rows && defects.inexact == 0; ++i)
            quantize_row(row_of(metres, place, i), base, steps_per_metre, surface.row(i).data(), defects);
        return defects.inexact == 0;
    };
    for (const std::int32_t steps : {100, 1000}) {
        const double farthest = static_cast<double>(farthest_step) / steps;
        if (!(lowest > -farthest && highest < farthest && (highest - lowest) * steps < 2 * (most - 1)))
            return false;
        steps_per_metre = steps;
        base = static_cast<std::int32_t>((lowest + highest) / 2 * steps);
        if (quantize_all())
            return true;
    }
    return false;
}

D2B_MULTIVERSION void QuantizedElevations::to_metres(std::span<const std::int16_t> values,
                                                     float* metres) const {
    const auto steps_per_m = static_cast<float>(steps_per_metre);
    for (std::size_t j = 0; j < values.size(); ++j) {
        const auto z = std::bit_cast<std::int32_t>(metres_of(base + values[j], steps_per_m));
        const std::int32_t known = all_bits_if(values[j] != none);
        metres[j] = std::bit_cast<float>((z & known) | (no_value_bits & ~known));
    }
}

int QuantizedElevations::guaranteed_steps(float rise) const {
    constexpr int rounded_away = 2;
    return std::max(static_cast<int>(std::floor(static_cast<double>(rise) * steps_per_metre)) - rounded_away,
                    0);
}

}  // namespace d2b::ground

#include "ground/whole_steps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "ground/line_pass.hpp"

namespace d2b::ground {
namespace {

constexpr std::int32_t most = 32766;
constexpr std::int16_t none = no_value_of<std::int16_t>;

/// The lowest and highest elevation; the other way round where there is none.
struct Range {
    float lowest = no_value;
    float highest = -no_value;
};

Range range_of(const MetreGrid& metres) {
    Range range;
    for (const float z : metres.values) {
        const float known = z == no_value ? -no_value : z;
        range.lowest = z < range.lowest ? z : range.lowest;
        range.highest = known > range.highest ? known : range.highest;
    }
    return range;
}

/// Rounded to a float once: mostly what a file has that was written with so many digits.
float metres_of(std::int32_t steps, double step) {
    return static_cast<float>(steps * step);
}

/// Not of 0 and -0.
bool same_bits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

/// @return whether all of them are whole steps
bool take_row(std::span<const float> metres, std::int32_t base, std::int32_t in_metre, std::int16_t* values) {
    // Added and taken off again it rounds to a whole number: it leaves no digits behind the point.
    constexpr double rounder = 6755399441055744.0;  // 1.5 * 2^52
    const double step = 1.0 / in_metre;
    int broken = 0;
    for (std::size_t j = 0; j < metres.size(); ++j) {
        const float z = metres[j] == no_value ? 0 : metres[j];
        const double whole = (static_cast<double>(z) * in_metre + rounder) - rounder;
        const auto steps = static_cast<std::int32_t>(whole);
        broken |= same_bits(metres_of(steps, step), z) ? 0 : 1;
        values[j] = metres[j] == no_value ? none : static_cast<std::int16_t>(steps - base);
    }
    return broken == 0;
}

}  // namespace

bool WholeSteps::take(const MetreGrid& metres) {
    const Range range = range_of(metres);
    const auto lowest = static_cast<double>(std::min(range.lowest, range.highest));
    const auto highest = static_cast<double>(std::max(range.lowest, range.highest));
    surface.rows = metres.rows;
    surface.cols = metres.cols;
    surface.values.resize(metres.size());
    const auto take_all = [&] {
        for (std::int32_t i = 0; i < metres.rows; ++i)
            if (!take_row(metres.row(i), base, in_metre, surface.row(i).data()))
                return false;
        return true;
    };
    for (const std::int32_t steps : {100, 1000}) {
        // A float this far from 0 still has a tenth of a step.
        const double farthest = 1638400.0 / steps;
        if (!(lowest > -farthest && highest < farthest && (highest - lowest) * steps < 2 * (most - 1)))
            return false;
        in_metre = steps;
        base = static_cast<std::int32_t>((lowest + highest) / 2 * steps);
        if (take_all())
            return true;
    }
    return false;
}

void WholeSteps::in_metres(std::span<const std::int16_t> values, float* metres) const {
    const double step = 1.0 / in_metre;
    for (std::size_t j = 0; j < values.size(); ++j) {
        const float z = metres_of(base + values[j], step);
        metres[j] = values[j] == none ? no_value : z;
    }
}

int WholeSteps::surely_within(float rise) const {
    constexpr int rounded_away = 2;
    return std::max(static_cast<int>(std::floor(static_cast<double>(rise) * in_metre)) - rounded_away, 0);
}

}  // namespace d2b::ground

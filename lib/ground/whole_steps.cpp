#include "ground/whole_steps.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/processors.hpp"
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

/// In lanes, which processors do at once.
D2B_FOR_EACH_PROCESSOR Range range_of(std::span<const float> metres) {
    constexpr std::size_t lanes = 16;
    std::array<float, lanes> lowest{};
    std::array<float, lanes> highest{};
    lowest.fill(no_value);
    highest.fill(-no_value);
    const auto look = [&](float z, std::size_t lane) {
        const float known = z == no_value ? -no_value : z;
        lowest[lane] = z < lowest[lane] ? z : lowest[lane];
        highest[lane] = known > highest[lane] ? known : highest[lane];
    };
    std::size_t i = 0;
    for (; i + lanes <= metres.size(); i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane)
            look(metres[i + lane], lane);
    for (; i < metres.size(); ++i)
        look(metres[i], 0);
    return {std::ranges::min(lowest), std::ranges::max(highest)};
}

/// Rounded to a float once: mostly what a file has that was written with so many digits.
float metres_of(std::int32_t steps, double step) {
    return static_cast<float>(steps * step);
}

/// @return whether all of them are whole steps, bit by bit: -0 is none
D2B_FOR_EACH_PROCESSOR bool take_row(std::span<const float> metres, std::int32_t base, std::int32_t in_metre,
                                     std::int16_t* values) {
    // Added and taken off again it rounds to a whole number: it leaves no digits behind the point.
    constexpr double rounder = 6755399441055744.0;  // 1.5 * 2^52
    const double step = 1.0 / in_metre;
    const double in_each = in_metre;
    std::int32_t broken = 0;
    for (std::size_t j = 0; j < metres.size(); ++j) {
        const float z = metres[j];
        const float here = z == no_value ? 0.0F : z;
        const double whole = (static_cast<double>(here) * in_each + rounder) - rounder;
        const auto steps = static_cast<std::int32_t>(whole);
        broken |= std::bit_cast<std::int32_t>(metres_of(steps, step)) ^ std::bit_cast<std::int32_t>(here);
        values[j] = static_cast<std::int16_t>(z == no_value ? none : steps - base);
    }
    return broken == 0;
}

}  // namespace

bool WholeSteps::take(const MetreGrid& metres) {
    const Range range = range_of(metres.values);
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

D2B_FOR_EACH_PROCESSOR void WholeSteps::in_metres(std::span<const std::int16_t> values, float* metres) const {
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

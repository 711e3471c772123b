#include "elevations/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace d2b {

/// Uses lanes, so that the loop vectorises.
ValueRange value_range(std::span<const double> values) {
    constexpr std::size_t lanes = 4;
    std::array<double, lanes> lowest{};
    std::array<double, lanes> highest{};
    std::array<double, lanes> known{};
    lowest.fill(ValueRange{}.lowest);
    highest.fill(ValueRange{}.highest);
    const auto update = [&](std::size_t i, std::size_t lane) {
        const double z = values[i];
        lowest[lane] = z < lowest[lane] ? z : lowest[lane];
        highest[lane] = z > highest[lane] ? z : highest[lane];
        known[lane] += z == z ? 1.0 : 0.0;
    };
    std::size_t i = 0;
    for (; i + lanes <= values.size(); i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane)
            update(i + lane, lane);
    for (; i < values.size(); ++i)
        update(i, 0);
    return {std::ranges::min(lowest), std::ranges::max(highest),
            static_cast<std::size_t>(known[0] + known[1] + known[2] + known[3])};
}

void ElevationStatistics::add(std::span<const double> elevations) {
    moments.add_valid(elevations);
    const ValueRange of = value_range(elevations);
    // The first of equal values, 0 or -0.
    if (of.lowest < minimum)
        minimum = *std::ranges::find(elevations, of.lowest);
    if (of.highest > maximum)
        maximum = *std::ranges::find(elevations, of.highest);
}

void ElevationStatistics::add(double elevation) {
    moments.add(elevation);
    minimum = std::min(minimum, elevation);
    maximum = std::max(maximum, elevation);
}

void ElevationStatistics::merge(const ElevationStatistics& other) {
    moments.merge(other.moments);
    minimum = std::min(minimum, other.minimum);
    maximum = std::max(maximum, other.maximum);
}

ElevationRange ElevationStatistics::range() const {
    return moments.n > 0 ? ElevationRange{minimum, maximum} : ElevationRange{};
}

FixedPoint ElevationStatistics::fixed_point() const {
    return FixedPoint(moments.n > 0 ? std::max(std::abs(minimum), std::abs(maximum)) : 0.0);
}

}  // namespace d2b

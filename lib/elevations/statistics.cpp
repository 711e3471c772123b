#include "elevations/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

namespace d2b {

/// Uses pairs, the vectors of the compiler, because it keeps arrays in memory.
ValueRange value_range(std::span<const double> values) {
    using Pair [[gnu::vector_size(2 * sizeof(double))]] = double;
    Pair lowest = Pair{} + ValueRange{}.lowest;
    Pair highest = Pair{} + ValueRange{}.highest;
    Pair known{};
    const auto update = [&](Pair z) {
        lowest = z < lowest ? z : lowest;
        highest = z > highest ? z : highest;
        known += z == z ? Pair{1, 1} : Pair{};
    };
    std::size_t i = 0;
    for (Pair pair; i + 2 <= values.size(); i += 2) {
        std::memcpy(&pair, &values[i], sizeof pair);
        update(pair);
    }
    if (i < values.size())
        update(Pair{values[i], std::numeric_limits<double>::quiet_NaN()});
    return {std::min(lowest[0], lowest[1]), std::max(highest[0], highest[1]),
            static_cast<std::size_t>(known[0] + known[1])};
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

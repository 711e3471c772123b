#include "elevations/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/grid.hpp"

namespace d2b {

/// Uses lanes, so that the loop vectorises; their number keeps the compiler from unrolling the loop over
/// them.
D2B_MULTIVERSION ValueRange value_range(std::span<const double> values) {
    constexpr std::size_t lanes = 64;
    std::array<double, lanes> lowest{};
    std::array<double, lanes> highest{};
    lowest.fill(ValueRange{}.lowest);
    highest.fill(ValueRange{}.highest);
    const auto update = [&](double z, std::size_t lane) {
        lowest[lane] = z < lowest[lane] ? z : lowest[lane];
        highest[lane] = z > highest[lane] ? z : highest[lane];
    };
    std::size_t i = 0;
    for (; i + lanes <= values.size(); i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane)
            update(values[i + lane], lane);
    for (; i < values.size(); ++i)
        update(values[i], 0);
    return {std::ranges::min(lowest), std::ranges::max(highest)};
}

void ElevationStatistics::add(const ElevationBand& band) {
    add(band, {0, 0, band.shape.rows, band.shape.cols});
}

void ElevationStatistics::add(const ElevationBand& band, const Window& part) {
    for (std::int32_t row = part.row; row < part.end_row(); ++row) {
        const auto cells =
            band.row(row).subspan(static_cast<std::size_t>(part.col), static_cast<std::size_t>(part.cols));
        moments.add_valid(cells);
        const ValueRange of = value_range(cells);
        // The first of equal values, 0 or -0.
        if (of.lowest < minimum)
            minimum = *std::ranges::find(cells, of.lowest);
        if (of.highest > maximum)
            maximum = *std::ranges::find(cells, of.highest);
    }
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

#include "elevations/statistics.hpp"

#include <algorithm>
#include <cmath>

#include "elevations/row_extremes.hpp"

namespace d2b {

void ElevationStatistics::add(const ElevationBand& band) {
    add(band, {0, 0, band.shape.rows, band.shape.cols});
}

void ElevationStatistics::add(const ElevationBand& band, const Window& part) {
    for (std::int32_t row = part.row; row < part.end_row(); ++row) {
        const auto cells =
            band.row(row).subspan(static_cast<std::size_t>(part.col), static_cast<std::size_t>(part.cols));
        moments.add_known(cells);
        const RowExtremes of = extremes_of_row(cells);
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

#include "elevations/spikes.hpp"

#include <algorithm>
#include <cstddef>

namespace d2b {
namespace {

/// Returns the higher neighbour of a column in a row; -infinity if neither is valid.
double beside(std::span<const double> row, std::size_t col) {
    double highest = -std::numeric_limits<double>::infinity();
    if (col > 0 && row[col - 1] > highest)
        highest = row[col - 1];
    if (col + 1 < row.size() && row[col + 1] > highest)
        highest = row[col + 1];
    return highest;
}

}  // namespace

void Spike::see(std::span<const double> other) {
    const auto at = static_cast<std::size_t>(col);
    around = std::max(around, beside(other, at));
    if (other[at] > around)
        around = other[at];
}

std::vector<Spike> find_spikes(const ElevationBand& band, std::span<const Stretch> steep,
                               const SpikeRules& rules) {
    std::vector<Spike> spikes;
    for (const Stretch& stretch : steep) {
        const std::span<const double> row = band.row(stretch.row);
        for (std::int32_t col = stretch.begin; col < stretch.end; ++col) {
            const auto at = static_cast<std::size_t>(col);
            Spike spike{stretch.row, col, row[at], beside(row, at)};
            if (!spike.above(rules.no_roof))  // also for NaN
                continue;
            if (stretch.row > 0)
                spike.see(band.row(stretch.row - 1));
            if (stretch.row + 1 < band.shape.rows)
                spike.see(band.row(stretch.row + 1));
            if (spike.above(rules.no_roof))
                spikes.push_back(spike);
        }
    }
    return spikes;
}

std::vector<Spike> SpikeSeams::add(const ElevationBand& band, std::vector<Spike> spikes) {
    for (Spike& spike : waiting_)
        if (spike.row == last_)
            spike.see(band.row(0));
    for (Spike& spike : spikes)
        if (spike.row == 0 && !last_row_.empty())
            spike.see(last_row_);
    last_ = band.shape.rows - 1;
    last_row_.assign(band.row(last_).begin(), band.row(last_).end());
    return std::exchange(waiting_, std::move(spikes));
}

}  // namespace d2b

#include "diagnose/ground_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/row_bands.hpp"

namespace d2b {

std::size_t GroundFit::bin_of(double height) {
    const double bin = (height + highest_m) / bin_m;
    return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(bins - 1)));
}

void GroundFit::add(std::span<const float> surface, std::span<const float> ground) {
    for (std::size_t i = 0; i < surface.size(); ++i) {
        const float height = surface[i] - ground[i];
        if (std::isnan(height))
            continue;
        ++cells_;
        bare_ += height <= min_height_ ? 1 : 0;
        ++counts_[bin_of(static_cast<double>(height))];
    }
}

void GroundFit::merge(const GroundFit& other) {
    cells_ += other.cells_;
    bare_ += other.bare_;
    for (std::size_t i = 0; i < bins; ++i)
        counts_[i] += other.counts_[i];
}

double GroundFit::bare_share() const {
    return cells_ == 0 ? 1 : static_cast<double>(bare_) / static_cast<double>(cells_);
}

double GroundFit::share_above(double height) const {
    const auto first = counts_.begin() + static_cast<std::ptrdiff_t>(bin_of(height));
    const std::int64_t above = std::accumulate(first, counts_.end(), std::int64_t{0});
    return cells_ == 0 ? 0 : static_cast<double>(above) / static_cast<double>(cells_);
}

double GroundFit::middle(std::int64_t cells) const {
    if (cells == 0)
        return std::numeric_limits<double>::quiet_NaN();
    std::int64_t below = 0;
    std::size_t bin = 0;
    while (2 * (below + counts_[bin]) < cells)
        below += counts_[bin++];
    return (static_cast<double>(bin) + 0.5) * bin_m - highest_m;
}

void add_fit(const MetreGrid& surface, const MetreGrid& ground, const Window& cells, GroundFit& fit,
             Executor& threads) {
    const auto col = static_cast<std::size_t>(cells.col);
    const auto cols = static_cast<std::size_t>(cells.cols);
    const auto add_band = [&](RowBand band, GroundFit& some) {
        for (std::int32_t r = cells.row + band.begin; r < cells.row + band.end; ++r)
            some.add(surface.row(r).subspan(col, cols), ground.row(r).subspan(col, cols));
    };
    fit.merge(sum_of_row_bands(threads, cells.rows, cells.cols, GroundFit(fit.min_height()), add_band));
}

}  // namespace d2b

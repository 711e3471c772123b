#include "diagnose/ground_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/processors.hpp"
#include "core/row_bands.hpp"

namespace d2b {

/// Returns the first bin for NaN. Branch-free, so that the loop vectorises.
std::int32_t GroundFit::bin_of(double height) {
    const double bin = (height + highest_m) / bin_m;
    constexpr double last = bins - 1;
    const double not_below = bin > 0 ? bin : 0;
    return static_cast<std::int32_t>(not_below < last ? not_below : last);
}

D2B_FOR_EACH_PROCESSOR void GroundFit::find_bins(std::span<const float> surface,
                                                 std::span<const float> ground,
                                                 std::span<std::int32_t> found) {
    std::int32_t known = 0;
    std::int32_t bare = 0;
    for (std::size_t i = 0; i < surface.size(); ++i) {
        const float height = surface[i] - ground[i];
        known += height == height ? 1 : 0;
        bare += height <= min_height_ ? 1 : 0;
        const std::int32_t bin = bin_of(static_cast<double>(height));
        found[i] = height == height ? bin : unknown;
    }
    cells_ += known;
    bare_ += bare;
}

void GroundFit::add(std::span<const float> surface, std::span<const float> ground) {
    constexpr std::size_t piece = 256;
    std::array<std::int32_t, piece> found{};
    for (std::size_t first = 0; first < surface.size(); first += piece) {
        const std::size_t n = std::min(piece, surface.size() - first);
        find_bins(surface.subspan(first, n), ground.subspan(first, n), found);
        for (std::size_t i = 0; i < n; ++i)
            if (found[i] != unknown)
                ++counts_[static_cast<std::size_t>(found[i])];
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
    const auto first = counts_.begin() + bin_of(height);
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

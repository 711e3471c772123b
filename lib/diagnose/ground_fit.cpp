#include "diagnose/ground_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "core/grid.hpp"
#include "core/text.hpp"
#include "diagnose/warnings.hpp"

namespace d2b {

/// Returns the first bin for NaN. Branch-free, so that the loop vectorises.
std::int32_t GroundFit::bin_of(double height) {
    const double bin = (height + highest_m) / bin_m;
    constexpr double last = bins - 1;
    const double not_below = bin > 0 ? bin : 0;
    return static_cast<std::int32_t>(not_below < last ? not_below : last);
}

D2B_MULTIVERSION void GroundFit::find_bins(std::span<const float> surface, std::span<const float> ground,
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
    fit.merge(reduce_row_bands(threads, cells.rows, cells.cols, GroundFit(fit.min_height()), add_band));
}

void add_slope(const MetreGrid& ground, const CellSize& cell, std::int32_t first_row, const Window& cells,
               GroundSlope& slope, Executor& threads) {
    constexpr std::int32_t every = 16;
    const auto end_col = static_cast<std::size_t>(std::min(cells.end_col(), ground.cols - 1));
    const auto add_row = [&](std::int32_t r, GroundSlope& sum) {
        const auto here = ground.row(r);
        const auto below = ground.row(r + 1);
        for (auto c = static_cast<std::size_t>(cells.col); c < end_col; ++c)
            sum.add(static_cast<double>(here[c + 1] - here[c]) / cell.across,
                    static_cast<double>(below[c] - here[c]) / cell.down);
    };
    const std::int32_t rows = std::min(cells.end_row(), ground.rows - 1) - cells.row;
    slope.merge(
        reduce_row_bands(threads, rows, ground.cols, GroundSlope(), [&](RowBand band, GroundSlope& sum) {
            for (std::int32_t r = band.begin; r < band.end; ++r)
                if ((first_row + cells.row + r) % every == 0)
                    add_row(cells.row + r, sum);
        }));
}

std::string slope_warning(const GroundSlope& slope, const std::string& dem) {
    if (2 * slope.steep_cells <= slope.cells)
        return {};
    const double share = static_cast<double>(slope.steep_cells) / static_cast<double>(slope.cells);
    return percent(share) + " of the ground of '" + dem + "' is steeper than " + percent(GroundSlope::steep) +
           ", where buildings can hardly be told from the slope; give a terrain model with -ground, and "
           "check the units of elevations and coordinates (-zunit)";
}

namespace {

constexpr double fewest_bare = 0.05;
constexpr double farthest_m = 2;
constexpr double fewest_raised = 0.001;

std::string within(const GroundFit& fit) {
    return "only " + percent(fit.bare_share()) + " of the cells lie within " + number_text(fit.min_height()) +
           " m of ";
}

std::string doubt_of_given(const GroundFit& fit, const std::string& terrain, bool few) {
    const std::string see = "; check whether both have the same unit and vertical datum";
    if (few)
        return within(fit) + "the terrain '" + terrain + "', above which the surface lies " +
               rounded(fit.median()) + " m (median)" + see;
    const double median = fit.bare_median();
    return "the terrain '" + terrain + "' lies " + rounded(std::abs(median)) + " m " +
           (median < 0 ? "above" : "below") + " the surface where nothing stands on it (median)" + see;
}

}  // namespace

std::string ground_warning(const GroundFit& fit, GroundMode mode, const std::string& terrain) {
    const bool few = fit.bare_share() < fewest_bare;
    if (fit.cells() == 0 || (!few && !(std::abs(fit.bare_median()) > farthest_m)))
        return {};
    if (mode == GroundMode::given)
        return doubt_of_given(fit, terrain, few);
    if (mode == GroundMode::none)
        return "-ground none takes elevations as heights above the ground, and their median is " +
               rounded(few ? fit.median() : fit.bare_median()) + " m" + (few ? "" : " where they are low") +
               "; give a terrain model with -ground, or leave -ground out to have the ground estimated";
    return within(fit) + "the ground that was estimated" +
           (few ? "" : ", and these " + rounded(fit.bare_median()) + " m above it (median)") +
           "; give a terrain model with -ground, or use a larger part of the raster";
}

std::string surface_warning(const GroundFit& fit, const std::string& dem) {
    const double usual = DetectOptions{}.min_height;
    const double share = fit.share_above(usual);
    if (fit.cells() == 0 || share >= fewest_raised)
        return {};
    return (share > 0 ? percent(share) : "none") + " of the cells of '" + dem + "' rise by more than " +
           number_text(usual) +
           " m above their surroundings, as in a terrain model (DTM), which has no buildings; give the "
           "surface model (DSM)";
}

}  // namespace d2b

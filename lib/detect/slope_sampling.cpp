#include "detect/slope_sampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace d2b::detect {
namespace {

constexpr double error_bin_m = 0.02;
constexpr std::int64_t fewest_windows = 200;
constexpr double least_slope = 0.3;
constexpr double greatest_slope = 0.9;
/// Nine in ten windows of a plane with one point per cell have less than this: 1.33 times the root of 1 / 12.
constexpr double planar_cells = 0.38;

/// Fits a plane to the square of nine cells around a cell, by least squares.
struct WindowPlane {
    double slope = 0;
    double deviation = 0;  ///< standard deviation of the heights from the plane

    WindowPlane(const MetreGrid& z, const CellSize& cell, std::int32_t r, std::int32_t c) {
        const auto middle = static_cast<double>(z.at(r, c));
        double sum = 0;
        double squares = 0;
        double along_row = 0;
        double along_column = 0;
        for (std::int32_t y = -1; y <= 1; ++y)
            for (std::int32_t x = -1; x <= 1; ++x) {
                const double h = static_cast<double>(z.at(r + y, c + x)) - middle;
                sum += h;
                squares += h * h;
                along_row += x * h;
                along_column += y * h;
            }
        slope = std::hypot(along_row / (6 * cell.across), along_column / (6 * cell.down));
        const double rest =
            squares - sum * sum / 9 - (along_row * along_row + along_column * along_column) / 6;
        deviation = std::sqrt(std::max(0.0, rest) / 6);
    }
};

bool is_inside(const Mask& roofs, std::int32_t r, std::int32_t c) {
    for (std::int32_t y = r - 1; y <= r + 1; ++y) {
        const auto row = roofs.row(y);
        if (std::any_of(row.begin() + c - 1, row.begin() + c + 2, [](std::uint8_t set) { return set == 0; }))
            return false;
    }
    return true;
}

/// Returns the middle of the bin around which most errors lie, weighting neighbours of up to two bins less.
double most_frequent(const Histogram<SlopeErrors::bins>& errors) {
    constexpr std::array<std::int64_t, 5> weights{1, 2, 3, 2, 1};
    std::size_t best = 0;
    std::int64_t most = 0;
    for (std::size_t bin = 0; bin < SlopeErrors::bins; ++bin) {
        std::int64_t near = 0;
        for (std::size_t i = 0; i < weights.size(); ++i)
            if (bin + i >= 2 && bin + i - 2 < SlopeErrors::bins)
                near += weights[i] * errors.counts[bin + i - 2];
        if (near > most) {
            most = near;
            best = bin;
        }
    }
    return (static_cast<double>(best) + 0.5) * error_bin_m;
}

}  // namespace

std::optional<SlopeSampling> SlopeErrors::sampling() const {
    if (errors.all < fewest_windows)
        return std::nullopt;
    return SlopeSampling{most_frequent(errors),
                         static_cast<double>(planar) / static_cast<double>(errors.all)};
}

SlopeErrors slope_errors(const Scene& scene, const Mask& roofs, Executor& threads) {
    const auto add_row = [&](std::int32_t r, SlopeErrors& counts) {
        if (r == 0 || r + 1 == roofs.rows)
            return;
        for (std::int32_t c = 1; c + 1 < roofs.cols; ++c) {
            if (!is_inside(roofs, r, c))
                continue;
            const WindowPlane plane(scene.surface, scene.cell, r, c);
            if (!(plane.slope >= least_slope && plane.slope < greatest_slope))  // also if a height is NaN
                continue;
            const double error = plane.deviation / plane.slope;
            counts.errors.add(std::min(static_cast<std::size_t>(error / error_bin_m), SlopeErrors::bins));
            counts.planar += error < planar_cells * scene.side() ? 1 : 0;
        }
    };
    return reduce_rows(threads, roofs.rows, roofs.cols, SlopeErrors(), add_row);
}

}  // namespace d2b::detect

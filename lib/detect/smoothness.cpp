#include "detect/smoothness.hpp"

#include <cmath>
#include <span>

#include "core/grid.hpp"
#include "raster/plane_sums.hpp"

namespace d2b::detect {
namespace {

// The thresholds include noise up to this. Noise beyond it makes second differences 2.4 times as wide; crowns
// remain separable with less than that.
constexpr double usual_noise_m = 0.07;
constexpr double noise_factor = 1.5;

double noise_margin(double noise) {
    return noise_factor * std::max(0.0, noise - usual_noise_m);
}

// The step along a diagonal is longer, so that the same curvature bends twice as much, but noise does not: a
// compromise.
constexpr float diagonal = 1.0F / 1.5F;

float bend(float a, float middle, float b) {
    return std::abs(a + b - 2 * middle);
}

/// 0 for NaN, because unknown heights give no evidence of smoothness.
int bit_below(float value, float limit, int bit) {
    return value < limit ? bit : 0;
}

/// Branch-free, so that the loop vectorises.
std::uint8_t flags(float row, float column, float falling, float rising, const SmoothnessThresholds& t) {
    const int along =
        bit_below(row, t.line, smooth_along_row) | bit_below(column, t.line, smooth_along_column);
    const int any = bit_below(row, t.any, smooth_any_way) | bit_below(column, t.any, smooth_any_way) |
                    bit_below(falling * diagonal, t.any, smooth_any_way) |
                    bit_below(rising * diagonal, t.any, smooth_any_way);
    const int enough = bit_below(row, t.enough, smooth_enough) | bit_below(column, t.enough, smooth_enough);
    return static_cast<std::uint8_t>(along | any | enough);
}

D2B_MULTIVERSION void flag_row(const MetreGrid& surface, std::int32_t r, const SmoothnessThresholds& limits,
                               std::span<std::uint8_t> out) {
    const std::span<const float> up = surface.row(std::max(r - 1, 0));
    const std::span<const float> here = surface.row(r);
    const std::span<const float> down = surface.row(std::min(r + 1, surface.rows - 1));
    const auto at = [&](std::size_t west, std::size_t c, std::size_t east) {
        const float z = here[c];
        out[c] = flags(bend(here[west], z, here[east]), bend(up[c], z, down[c]),
                       bend(up[west], z, down[east]), bend(down[west], z, up[east]), limits);
    };
    if (out.empty())
        return;
    const std::size_t last = out.size() - 1;
    at(0, 0, std::min<std::size_t>(1, last));
    for (std::size_t c = 1; c < last; ++c)
        at(c - 1, c, c + 1);
    if (last > 0)
        at(last - 1, last, last);
}

constexpr double least_area_m2 = 12;
constexpr std::int64_t fewest_cells = 6;

std::vector<PlaneSums> plane_sums(const Scene& scene, const Regions& regions, Executor& threads) {
    std::vector<PlaneSums> sums(regions.count());
    for_runs_by_label(threads, regions, [&](std::int32_t r, const RegionRun& run) {
        const std::span<const float> surface = scene.surface.row(r);
        PlaneSums sum = sums[run.label - 1];
        for (std::int32_t c = run.begin; c < run.end; ++c)
            sum.add(r, c, surface[static_cast<std::size_t>(c)], scene.cell);
        sums[run.label - 1] = sum;
    });
    return sums;
}

/// Returns 1 if two neighbours are connected: one of them is straight along the line between them, or each is
/// straight in some direction.
/// @param line bit position of the direction of that line
int joins(int a, int b, int line) {
    constexpr int any_way = 2;
    static_assert(smooth_along_row == 1 << 0 && smooth_along_column == 1 << 1 &&
                  smooth_any_way == 1 << any_way);
    return (((a | b) >> line) | ((a & b) >> any_way)) & 1;
}

/// Computes the links of a row: cells are connected across edges at which the surface hardly bends.
void smooth_links(const Mask& mask, const Grid<std::uint8_t>& flags, std::int32_t r,
                  std::vector<std::uint8_t>& links) {
    links.resize(static_cast<std::size_t>(mask.cols));
    const std::span<const std::uint8_t> cells = mask.row(r);
    const std::span<const std::uint8_t> cells_up = mask.row(std::max(r - 1, 0));
    const std::span<const std::uint8_t> here = flags.row(r);
    const std::span<const std::uint8_t> up = flags.row(std::max(r - 1, 0));
    const std::uint8_t has_up = r > 0 ? 1 : 0;
    static_assert(link_in == 1 && link_left == 2 && link_up == 4);
    // Bytes and shifts only, so that the loop vectorises.
    const auto link = [&](std::size_t c, int left) {
        const int in = cells[c];
        const int above = in & cells_up[c] & has_up & joins(up[c], here[c], 1);
        return static_cast<std::uint8_t>(in | (in & left) << 1 | above << 2);
    };
    const std::span<std::uint8_t> out(links);
    if (!out.empty())
        out[0] = link(0, 0);
    for (std::size_t c = 1; c < out.size(); ++c)
        out[c] = link(c, cells[c - 1] & joins(here[c - 1], here[c], 0));
}

}  // namespace

SmoothnessThresholds smoothness_thresholds(double side, const SurfaceQuality& quality) {
    const double room =
        noise_margin(quality.noise) + quality.margin_scale * sampling_margin(side, quality.filled);
    // Metres, and metres per metre of cell size. Fitted on cities with cells of 0.5 to 5 m, see
    // docs/accuracy.md.
    const auto limit = [&](double metres, double of_side) {
        return static_cast<float>(quality.threshold_scale * (metres + of_side * side) + room);
    };
    return {limit(0.06, 0.06), limit(0.10, 0.08), limit(0.13, 0.12)};
}

Grid<std::uint8_t> smoothness(const MetreGrid& surface, const SmoothnessThresholds& limits,
                              Executor& threads) {
    auto result = Grid<std::uint8_t>::unset(surface.rows, surface.cols, threads);
    for_rows(threads, surface.rows, surface.cols,
             [&](std::int32_t r) { flag_row(surface, r, limits, result.row(r)); });
    return result;
}

Regions smooth_regions(const Scene& scene, const Mask& cells, const Grid<std::uint8_t>& flags,
                       Executor& threads) {
    const auto links_of = [&](std::int32_t r, std::vector<std::uint8_t>& links) {
        smooth_links(cells, flags, r, links);
    };
    const std::int64_t least = std::max(fewest_cells, cells_covering(least_area_m2, scene.cell));
    return linked_regions(cells.rows, cells.cols, links_of, least, threads);
}

SmoothSegments smooth_segments(const Scene& scene, const Mask& elevated, const Grid<std::uint8_t>& flags,
                               Executor& threads) {
    SmoothSegments result{smooth_regions(scene, elevated, flags, threads), {}};
    for (const PlaneSums& sum : plane_sums(scene, result.regions, threads))
        result.pieces.push_back({sum.count(), sum.tilt()});
    return result;
}

}  // namespace d2b::detect

#include "detect/smooth_segments.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "detect/smoothness.hpp"

namespace d2b {
namespace {

constexpr double least_area_m2 = 12;
constexpr std::int64_t fewest_cells = 6;

/// Sums for the least-squares plane of a segment, relative to its first cell, because small numbers keep
/// their digits.
struct PlaneSums {
    std::int32_t row = 0;
    std::int32_t col = 0;
    float z = 0;
    double n = 0;
    double x = 0;
    double y = 0;
    double h = 0;
    double xx = 0;
    double xy = 0;
    double yy = 0;
    double xh = 0;
    double yh = 0;

    void add(double px, double py, double ph) {
        n += 1;
        x += px;
        y += py;
        h += ph;
        xx += px * px;
        xy += px * py;
        yy += py * py;
        xh += px * ph;
        yh += py * ph;
    }
    [[nodiscard]] double tilt() const {
        const double sxx = xx / n - x * x / n / n;
        const double sxy = xy / n - x * y / n / n;
        const double syy = yy / n - y * y / n / n;
        const double sxh = xh / n - x * h / n / n;
        const double syh = yh / n - y * h / n / n;
        // A collinear segment has no unique plane; the small number keeps it level across.
        const double det = sxx * syy - sxy * sxy + 1e-6;
        return std::hypot(sxh * syy - syh * sxy, syh * sxx - sxh * sxy) / det;
    }
};

std::vector<PlaneSums> plane_sums(const Scene& scene, const Regions& regions, Executor& threads) {
    std::vector<PlaneSums> sums(regions.count());
    for_runs_by_label(threads, regions, [&](std::int32_t r, const RegionRun& run) {
        const std::span<const float> surface = scene.surface.row(r);
        PlaneSums sum = sums[run.label - 1];
        if (sum.n == 0) {
            sum.row = r;
            sum.col = run.begin;
            sum.z = surface[static_cast<std::size_t>(run.begin)];
        }
        const double y = (r - sum.row) * scene.cell.down;
        for (std::int32_t c = run.begin; c < run.end; ++c)
            sum.add((c - sum.col) * scene.cell.across, y,
                    static_cast<double>(surface[static_cast<std::size_t>(c)] - sum.z));
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

Regions smooth_regions(const Scene& scene, const Mask& cells, const Grid<std::uint8_t>& flags,
                       Executor& threads) {
    const auto links_of = [&](std::int32_t r, std::vector<std::uint8_t>& links) {
        smooth_links(cells, flags, r, links);
    };
    const std::int64_t least = std::max(fewest_cells, cells_for(least_area_m2, scene.cell));
    return linked_regions(cells.rows, cells.cols, links_of, least, threads);
}

SmoothSegments smooth_segments(const Scene& scene, const Mask& elevated, const Grid<std::uint8_t>& flags,
                               Executor& threads) {
    SmoothSegments result{smooth_regions(scene, elevated, flags, threads), {}};
    for (const PlaneSums& sum : plane_sums(scene, result.regions, threads))
        result.pieces.push_back({static_cast<std::int64_t>(sum.n), sum.tilt()});
    return result;
}

}  // namespace d2b

#include "read/grid_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace d2b {

namespace {

constexpr double same_cell = 1e-3;
constexpr std::int32_t most_samples = 201;  // per row or column

/// Returns centres of evenly spaced cells, including the first and the last.
std::vector<double> sampled(std::int32_t first, std::int32_t count) {
    const std::int32_t n = std::min(count, most_samples);
    std::vector<double> centres;
    for (std::int32_t i = 0; i < n; ++i) {
        const std::int64_t step = n == 1 ? 0 : std::int64_t{i} * (count - 1) / (n - 1);
        centres.push_back(static_cast<double>(first + step) + 0.5);
    }
    return centres;
}

std::vector<Position> cell_centres(const Window& w) {
    const std::vector<double> cols = sampled(w.col, w.cols);
    std::vector<Position> centres;
    for (const double row : sampled(w.row, w.rows))
        for (const double col : cols)
            centres.push_back({col, row});
    return centres;
}

std::size_t count_inside(const std::vector<Position>& positions, const Window& w) {
    const auto inside = [&w](const Position& p) {
        return p.x >= w.col && p.x <= static_cast<double>(w.col) + w.cols && p.y >= w.row &&
               p.y <= static_cast<double>(w.row) + w.rows;
    };
    return static_cast<std::size_t>(std::count_if(positions.begin(), positions.end(), inside));
}

}  // namespace

std::optional<CellOffset> whole_cell_offset(const GridTransform& transform, const DemInfo& grid) {
    if (!transform.same_crs())
        return std::nullopt;
    const Window& w = grid.window;
    const double left = w.col;
    const double top = w.row;
    const double right = left + w.cols;
    const double bottom = top + w.rows;
    const std::array<Position, 4> corners{{{left, top}, {right, top}, {left, bottom}, {right, bottom}}};
    std::array<Position, 4> images = corners;
    transform.to_raster(images);
    const double cols = std::round(images[0].x - left);
    const double rows = std::round(images[0].y - top);
    constexpr double most = std::numeric_limits<std::int32_t>::max() / 2.0;
    if (!(std::abs(cols) < most && std::abs(rows) < most))
        return std::nullopt;
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (!(std::abs(images[i].x - corners[i].x - cols) < same_cell &&
              std::abs(images[i].y - corners[i].y - rows) < same_cell))
            return std::nullopt;
    return CellOffset{static_cast<std::int32_t>(rows), static_cast<std::int32_t>(cols)};
}

Coverage coverage(const GridTransform& transform, const DemInfo& raster, const DemInfo& grid) {
    const Window whole{0, 0, raster.rows, raster.cols};
    std::vector<Position> centres = cell_centres(grid.window);
    transform.to_raster(centres);
    const std::size_t covered = count_inside(centres, whole);
    if (covered > 0)
        return {static_cast<double>(covered) / static_cast<double>(centres.size()), true};
    std::vector<Position> others = cell_centres(whole);
    transform.to_grid(others);
    return {0, count_inside(others, grid.window) > 0};
}

std::array<double, 2> cell_in_raster(const GridTransform& transform, const DemInfo& grid) {
    const double col = grid.cols / 2.0;
    const double row = grid.rows / 2.0;
    std::array<Position, 3> p{{{col, row}, {col + 1, row}, {col, row + 1}}};
    transform.to_raster(p);
    const std::array<double, 2> size{std::hypot(p[1].x - p[0].x, p[2].x - p[0].x),
                                     std::hypot(p[1].y - p[0].y, p[2].y - p[0].y)};
    return std::isfinite(size[0] + size[1]) && size[0] > 0 && size[1] > 0 ? size : std::array{1.0, 1.0};
}

}  // namespace d2b

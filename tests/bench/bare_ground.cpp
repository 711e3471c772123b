#include "bare_ground.hpp"

#include <cmath>
#include <vector>

#include "cells.hpp"
#include "draft.hpp"

namespace d2b::bench {

namespace {

constexpr double spacing = 8;  // metres from lattice point to lattice point

/// Elevations along a line of lattice points from x = 0 on.
std::vector<double> lattice_line(const sample::Ground& ground, std::int64_t j, std::size_t points) {
    std::vector<double> line(points);
    for (std::size_t i = 0; i < points; ++i)
        line[i] = ground.at({static_cast<double>(i) * spacing, static_cast<double>(j) * spacing});
    return line;
}

/// The box of all that a scene's ground has been changed by.
std::vector<sample::Rect> changed_places(const sample::Ground& ground) {
    std::vector<sample::Rect> places;
    for (const sample::Terrace& terrace : ground.terraces)
        places.push_back(sample::bounds(terrace.frame.to_scene(sample::rectangle(terrace.rect)).exterior)
                             .grown(terrace.bank));
    for (const sample::Creek& creek : ground.creeks)
        places.push_back(sample::bounds(creek.line).grown(creek.half_width));
    return places;
}

}  // namespace

void lay_ground(const sample::Ground& ground, const sample::Grid& grid, std::int32_t first_row,
                std::int32_t rows, std::span<double> metres) {
    const auto points = static_cast<std::size_t>(grid.cols * grid.cell_x / spacing) + 2;
    std::int64_t lower = -1;
    std::vector<double> south;
    std::vector<double> north;
    std::size_t at = 0;
    for (std::int32_t row = first_row; row < first_row + rows; ++row) {
        const double y = grid.centre(row, 0).y / spacing;
        if (const auto j = static_cast<std::int64_t>(std::floor(y)); j != lower) {
            lower = j;
            south = lattice_line(ground, j, points);
            north = lattice_line(ground, j + 1, points);
        }
        const double v = y - static_cast<double>(lower);
        for (std::int32_t col = 0; col < grid.cols; ++col, ++at) {
            const double x = grid.centre(row, col).x / spacing;
            const auto i = static_cast<std::size_t>(x);
            const double u = x - static_cast<double>(i);
            metres[at] = (south[i] * (1 - u) + south[i + 1] * u) * (1 - v) +
                         (north[i] * (1 - u) + north[i + 1] * u) * v;
        }
    }
}

void lay_earthworks(const sample::Ground& ground, const sample::Grid& grid, std::int32_t first_row,
                    std::int32_t rows, std::span<double> metres) {
    for (const sample::Rect& place : changed_places(ground))
        for_cells(place, grid, first_row, rows,
                  [&](std::size_t at, const Position& p) { metres[at] = ground.at(p); });
}

}  // namespace d2b::bench

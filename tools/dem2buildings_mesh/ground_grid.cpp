// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/ground_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace d2b::mesh {
namespace {

/// True if a line at the height y crosses an edge; low ends belong to edges and high ones do not.
bool crosses(const Position& a, const Position& b, double y) {
    return (a.y <= y) != (b.y <= y);
}

double crossing(const Position& a, const Position& b, double y) {
    return a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
}

/// The first whole number whose centre, half further on, is not below x.
std::int32_t first_centre(double x, std::int32_t end) {
    return static_cast<std::int32_t>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(end)));
}

}  // namespace

GroundGrid::GroundGrid(std::int32_t rows, std::int32_t cols, std::vector<double> elevations,
                       const Affine& to_cells)
    : rows_(rows), cols_(cols), elevations_(std::move(elevations)), to_cells_(to_cells) {
    measured_.resize(elevations_.size());
    for (std::size_t i = 0; i < elevations_.size(); ++i)
        measured_[i] = !std::isnan(elevations_[i]);
    fill_gaps();
}

/// Fills gaps outwards from the known cells, one ring of cells after the other.
void GroundGrid::fill_gaps() {
    std::vector<std::size_t> front;
    const auto cols = static_cast<std::size_t>(cols_);
    for (std::size_t i = 0; i < elevations_.size(); ++i)
        if (!std::isnan(elevations_[i]))
            front.push_back(i);
    if (front.size() == elevations_.size())
        return;
    for (std::size_t next = 0; next < front.size(); ++next) {
        const std::size_t i = front[next];
        const auto take = [&](bool there, std::size_t neighbour) {
            if (!there || !std::isnan(elevations_[neighbour]))
                return;
            elevations_[neighbour] = elevations_[i];
            front.push_back(neighbour);
        };
        take(i >= cols, i - cols);
        take(i + cols < elevations_.size(), i + cols);
        take(i % cols > 0, i - 1);
        take(i % cols + 1 < cols, i + 1);
    }
}

Position GroundGrid::cell(const Position& at) const {
    return {to_cells_[0] + to_cells_[1] * at.x + to_cells_[2] * at.y,
            to_cells_[3] + to_cells_[4] * at.x + to_cells_[5] * at.y};
}

Position GroundGrid::plane(const Position& cell) const {
    const double x = cell.x - to_cells_[0];
    const double y = cell.y - to_cells_[3];
    const double determinant = to_cells_[1] * to_cells_[5] - to_cells_[2] * to_cells_[4];
    return {(x * to_cells_[5] - y * to_cells_[2]) / determinant,
            (y * to_cells_[1] - x * to_cells_[4]) / determinant};
}

Position GroundGrid::middle(std::size_t cell) const {
    const auto cols = static_cast<std::size_t>(cols_);
    const std::size_t row = cell / cols;
    const std::size_t col = cell % cols;
    return plane({static_cast<double>(col) + 0.5, static_cast<double>(row) + 0.5});
}

double GroundGrid::elevation(const Position& at) const {
    const Position cell = this->cell(at);
    const double x = std::clamp(cell.x - 0.5, 0.0, cols_ - 1.0);
    const double y = std::clamp(cell.y - 0.5, 0.0, rows_ - 1.0);
    const auto col = static_cast<std::size_t>(std::max(0.0, std::min(std::floor(x), cols_ - 2.0)));
    const auto row = static_cast<std::size_t>(std::max(0.0, std::min(std::floor(y), rows_ - 2.0)));
    const std::size_t right = cols_ > 1 ? 1 : 0;
    const std::size_t below = rows_ > 1 ? static_cast<std::size_t>(cols_) : 0;
    const std::size_t i = row * static_cast<std::size_t>(cols_) + col;
    const double u = x - static_cast<double>(col);
    const double v = y - static_cast<double>(row);
    const double upper = elevations_[i] + (elevations_[i + right] - elevations_[i]) * u;
    const double lower =
        elevations_[i + below] + (elevations_[i + below + right] - elevations_[i + below]) * u;
    return upper + (lower - upper) * v;
}

void GroundGrid::leave_out(const std::vector<std::array<Position, 2>>& edges) {
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(rows_));
    for (const auto& [from, to] : edges) {
        const Position a = cell(from);
        const Position b = cell(to);
        const std::int32_t end = first_centre(std::max(a.y, b.y) + 1, rows_);
        for (std::int32_t row = first_centre(std::min(a.y, b.y), rows_); row < end; ++row)
            if (crosses(a, b, row + 0.5))
                crossings[static_cast<std::size_t>(row)].push_back(crossing(a, b, row + 0.5));
    }
    for (std::int32_t row = 0; row < rows_; ++row) {
        std::vector<double>& at = crossings[static_cast<std::size_t>(row)];
        std::ranges::sort(at);
        for (std::size_t i = 0; i + 1 < at.size(); i += 2)
            for (std::int32_t col = first_centre(at[i], cols_); col < first_centre(at[i + 1], cols_); ++col)
                measured_[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) +
                          static_cast<std::size_t>(col)] = false;
    }
}

std::int64_t GroundGrid::measured() const {
    return std::ranges::count(measured_, true);
}

bool GroundGrid::errors(const std::array<Position, 3>& corners, const std::array<double, 3>& heights,
                        const std::function<bool(std::size_t cell, double error)>& take) const {
    const std::array<Position, 3> at{cell(corners[0]), cell(corners[1]), cell(corners[2])};
    const double ux = at[1].x - at[0].x;
    const double uy = at[1].y - at[0].y;
    const double vx = at[2].x - at[0].x;
    const double vy = at[2].y - at[0].y;
    const double area = ux * vy - uy * vx;
    const double low = std::min({at[0].y, at[1].y, at[2].y});
    const std::int32_t end = first_centre(std::max({at[0].y, at[1].y, at[2].y}), rows_);
    for (std::int32_t row = first_centre(low, rows_); row < end; ++row) {
        const double y = row + 0.5;
        std::array<double, 3> x{};
        std::size_t found = 0;
        for (std::size_t i = 0; i < 3; ++i)
            if (crosses(at[i], at[(i + 1) % 3], y))
                x[found++] = crossing(at[i], at[(i + 1) % 3], y);
        if (found != 2)
            continue;
        const std::int32_t last = first_centre(std::max(x[0], x[1]), cols_);
        for (std::int32_t col = first_centre(std::min(x[0], x[1]), cols_); col < last; ++col) {
            const std::size_t i = static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) +
                                  static_cast<std::size_t>(col);
            if (!measured_[i])
                continue;
            const double px = col + 0.5 - at[0].x;
            const double py = y - at[0].y;
            const double s = (px * vy - py * vx) / area;
            const double t = (py * ux - px * uy) / area;
            const double height = heights[0] + (heights[1] - heights[0]) * s + (heights[2] - heights[0]) * t;
            if (!take(i, std::abs(height - elevations_[i])))
                return false;
        }
    }
    return true;
}

}  // namespace d2b::mesh

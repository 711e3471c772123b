#include "outline/walls/wall_samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace d2b {

FinePoint CellShape::to_fine(Vec place, LatticePoint origin) const {
    const double scale = FinePoint::steps / cross(col, row);
    return {origin.row * FinePoint::steps + std::llround(cross(col, place) * scale),
            origin.col * FinePoint::steps + std::llround(cross(place, row) * scale)};
}

Vec CellShape::from_fine(FinePoint point, LatticePoint origin) const {
    const FinePoint from = fine(origin);
    return from_cells(static_cast<double>(point.row - from.row) / FinePoint::steps,
                      static_cast<double>(point.col - from.col) / FinePoint::steps);
}

WallSamples::WallSamples(const std::vector<LatticePoint>& trace, bool closed, const CellShape& shape)
    : closed_(closed), shape_(shape), origin_(trace.front()) {
    const std::size_t edges = closed ? trace.size() : trace.size() - 1;
    const auto to = [&](std::size_t i) { return trace[i + 1 < trace.size() ? i + 1 : 0]; };
    for (std::size_t i = 0; i < edges; ++i)
        steps_ +=
            static_cast<std::size_t>(std::abs(to(i).row - trace[i].row) + std::abs(to(i).col - trace[i].col));
    points_.reserve(steps_ + 1);
    corner_steps_.reserve(trace.size());
    corner_at_.reserve(steps_ + 2);
    for (std::size_t i = 0; i < edges; ++i)
        add_edge(trace[i], to(i));
    if (!closed) {
        corner_at_.push_back(static_cast<std::uint32_t>(corner_steps_.size()));
        corner_steps_.push_back(static_cast<std::uint32_t>(steps_));
        points_.push_back(shape.from_cells(trace.back().row - origin_.row, trace.back().col - origin_.col));
    }
    add_up();
}

void WallSamples::add_edge(LatticePoint from, LatticePoint to) {
    const std::int32_t n = std::abs(to.row - from.row) + std::abs(to.col - from.col);
    const auto unit = [](std::int32_t way) { return way > 0 ? 1 : (way < 0 ? -1 : 0); };
    const std::int32_t down = unit(to.row - from.row);
    const std::int32_t across = unit(to.col - from.col);
    corner_at_.push_back(static_cast<std::uint32_t>(corner_steps_.size()));
    corner_steps_.push_back(static_cast<std::uint32_t>(points_.size()));
    corner_at_.insert(corner_at_.end(), static_cast<std::size_t>(n - 1),
                      static_cast<std::uint32_t>(corner_steps_.size()));
    for (std::int32_t k = 0; k < n; ++k)
        points_.push_back(
            shape_.from_cells(from.row - origin_.row + down * k, from.col - origin_.col + across * k));
}

WallSamples::Cells WallSamples::beside(std::size_t step) const {
    const Vec half = 0.5 * (at(step + 1) - at(step));
    const double area = cross(shape_.col, shape_.row);
    const Vec left =
        (cross(shape_.col, half) / area) * shape_.col - (cross(half, shape_.row) / area) * shape_.row;
    const Vec middle = at(step) + half;
    return {middle + left, middle - left};
}

void WallSamples::add_up() {
    running_.reserve(steps_ + 1);
    Moments sum{};
    running_.push_back(sum);
    for (std::size_t i = 0; i < steps_; ++i) {
        const Vec middle = 0.5 * (points_[i] + points_[wrap(i + 1)]);
        sum[0] += middle.x;
        sum[1] += middle.y;
        sum[2] += middle.x * middle.x;
        sum[3] += middle.x * middle.y;
        sum[4] += middle.y * middle.y;
        running_.push_back(sum);
    }
}

/// Half the angle of (xx - yy, 2 xy), without trigonometric functions.
Vec WallSamples::Sums::direction() const {
    const double c = xx - yy;
    const double s = 2 * xy;
    const double r = std::sqrt(c * c + s * s);
    if (r == 0)
        return {1, 0};
    if (c >= 0) {
        const double cosine = std::sqrt((1 + c / r) / 2);
        return {cosine, s / r / (2 * cosine)};
    }
    const double sine = std::copysign(std::sqrt((1 - c / r) / 2), s);
    return {s / r / (2 * sine), sine};
}

WallSamples::Sums WallSamples::sums(std::size_t first, std::size_t last) const {
    Moments m{};
    const auto add = [&](std::size_t from, std::size_t to) {
        for (std::size_t k = 0; k < m.size(); ++k)
            m[k] += running_[to][k] - running_[from][k];
    };
    if (first >= steps_) {
        add(first - steps_, last - steps_);
    } else if (last > steps_) {
        add(first, steps_);
        add(0, last - steps_);
    } else {
        add(first, last);
    }
    Sums result;
    result.n = static_cast<double>(last - first);
    result.mean = {m[0] / result.n, m[1] / result.n};
    result.xx = m[2] - m[0] * result.mean.x;
    result.xy = m[3] - m[0] * result.mean.y;
    result.yy = m[4] - m[1] * result.mean.y;
    return result;
}

bool WallSamples::near(std::size_t first, std::size_t last, const Line& line, double limit) const {
    bool all = std::abs(line.off(at(first))) <= limit && std::abs(line.off(at(last))) <= limit;
    if (all)
        for_corners(first, last, [&](std::size_t, Vec corner) {
            all = std::abs(line.off(corner)) <= limit;
            return all;
        });
    return all;
}

}  // namespace d2b

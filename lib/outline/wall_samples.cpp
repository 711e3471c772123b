#include "outline/wall_samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace d2b {

double length(Vec a) {
    return std::hypot(a.x, a.y);
}

double distance(Vec p, Vec a, Vec b) {
    const Vec along = b - a;
    const double square = dot(along, along);
    const double share = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0.0;
    return length(p - a - share * along);
}

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
    : closed_(closed) {
    const LatticePoint origin = trace.front();
    const std::size_t edges = closed ? trace.size() : trace.size() - 1;
    for (std::size_t i = 0; i < edges; ++i) {
        const LatticePoint from = trace[i];
        const LatticePoint to = trace[(i + 1) % trace.size()];
        const std::int32_t n = std::max(std::abs(to.row - from.row), std::abs(to.col - from.col));
        const std::int32_t down = n > 0 ? (to.row - from.row) / n : 0;
        const std::int32_t across = n > 0 ? (to.col - from.col) / n : 0;
        step_of_.push_back(points_.size());
        for (std::int32_t k = 0; k < n; ++k) {
            points_.push_back(
                shape.from_cells(from.row - origin.row + down * k, from.col - origin.col + across * k));
            corner_.push_back(k == 0);
        }
    }
    steps_ = points_.size();
    if (!closed) {
        step_of_.push_back(steps_);
        points_.push_back(shape.from_cells(trace.back().row - origin.row, trace.back().col - origin.col));
        corner_.push_back(true);
    }
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

double WallSamples::Sums::least_squares() const {
    return std::max(0.0, (xx + yy - std::hypot(xx - yy, 2 * xy)) / 2);
}

Vec WallSamples::Sums::direction() const {
    const double angle = std::atan2(2 * xy, xx - yy) / 2;
    return {std::cos(angle), std::sin(angle)};
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

double WallSamples::largest_off(std::size_t first, std::size_t last, const Line& line, double limit) const {
    double largest = 0;
    for (std::size_t i = first; i <= last && largest <= limit; ++i)
        if (corner(i) || i == first || i == last)
            largest = std::max(largest, std::abs(line.off(at(i))));
    return largest;
}

}  // namespace d2b

#include "outline/walls/trace_sums.hpp"

#include <cstdlib>
#include <utility>

namespace d2b::outline {

FinePoint CellShape::to_fine(Vec2 place, LatticePoint origin) const {
    const double scale = FinePoint::steps / cross(col, row);
    return {origin.row * FinePoint::steps + std::llround(cross(col, place) * scale),
            origin.col * FinePoint::steps + std::llround(cross(place, row) * scale)};
}

Vec2 CellShape::from_fine(FinePoint point, LatticePoint origin) const {
    const FinePoint from = fine(origin);
    return from_cells(static_cast<double>(point.row - from.row) / FinePoint::steps,
                      static_cast<double>(point.col - from.col) / FinePoint::steps);
}

TraceSums::TraceSums(const std::vector<LatticePoint>& trace, bool closed, const CellShape& shape)
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
    accumulate();
}

void TraceSums::add_edge(LatticePoint from, LatticePoint to) {
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

TraceSums::Cells TraceSums::adjacent_cells(std::size_t step) const {
    const Vec2 half = 0.5 * (at(step + 1) - at(step));
    const double area = cross(shape_.col, shape_.row);
    const Vec2 left =
        (cross(shape_.col, half) / area) * shape_.col - (cross(half, shape_.row) / area) * shape_.row;
    const Vec2 middle = at(step) + half;
    return {middle + left, middle - left};
}

void TraceSums::accumulate() {
    prefix_sums_.reserve(steps_ + 1);
    Moments sum{};
    prefix_sums_.push_back(sum);
    for (std::size_t i = 0; i < steps_; ++i) {
        const Vec2 middle = 0.5 * (points_[i] + points_[wrap(i + 1)]);
        sum[0] += middle.x;
        sum[1] += middle.y;
        sum[2] += middle.x * middle.x;
        sum[3] += middle.x * middle.y;
        sum[4] += middle.y * middle.y;
        prefix_sums_.push_back(sum);
    }
}

/// Half the angle of (xx - yy, 2 xy), without trigonometric functions.
Vec2 TraceSums::Sums::direction() const {
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

TraceSums::Sums TraceSums::sums(std::size_t first, std::size_t last) const {
    Moments m{};
    const auto add = [&](std::size_t from, std::size_t to) {
        for (std::size_t k = 0; k < m.size(); ++k)
            m[k] += prefix_sums_[to][k] - prefix_sums_[from][k];
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

bool TraceSums::near(std::size_t first, std::size_t last, const Line2& line, double limit) const {
    bool all = std::abs(line.offset(at(first))) <= limit && std::abs(line.offset(at(last))) <= limit;
    if (all)
        for_corners(first, last, [&](std::size_t, Vec2 corner) {
            all = std::abs(line.offset(corner)) <= limit;
            return all;
        });
    return all;
}

namespace {

constexpr std::size_t max_run_span = 512;  // steps; bounds the time spent on a long chain

void divide(const TraceSums& samples, std::size_t begin, std::size_t end, double tolerance,
            std::vector<std::size_t>& points) {
    std::vector<std::pair<std::size_t, std::size_t>> open;
    open.reserve(16);
    open.emplace_back(begin, end);
    while (!open.empty()) {
        const auto [first, last] = open.back();
        open.pop_back();
        double largest = tolerance * tolerance;
        std::size_t farthest = first;
        const Vec2 from = samples.at(first);
        const Vec2 to = samples.at(last);
        samples.for_corners(first + 1, last - 1, [&](std::size_t i, Vec2 corner) {
            const double offset = square_distance(corner, from, to);
            if (offset > largest) {
                largest = offset;
                farthest = i;
            }
            return true;
        });
        if (farthest == first)
            continue;
        points.push_back(farthest);
        open.emplace_back(first, farthest);
        open.emplace_back(farthest, last);
    }
}

/// Central moments of points; z is the squared distance from the mean.
struct CircleMoments {
    Vec2 mean;
    double xx = 0;
    double xy = 0;
    double yy = 0;
    double xz = 0;
    double yz = 0;
    double zz = 0;
};

CircleMoments moments(const TraceSums& samples, std::size_t first, std::size_t last) {
    CircleMoments m;
    m.mean = samples.sums(first, last).mean;
    for (std::size_t i = first; i < last; ++i) {
        const Vec2 p = samples.midpoint(i) - m.mean;
        const double z = dot(p, p);
        m.xx += p.x * p.x;
        m.xy += p.x * p.y;
        m.yy += p.y * p.y;
        m.xz += p.x * z;
        m.yz += p.y * z;
        m.zz += z * z;
    }
    const auto n = static_cast<double>(last - first);
    for (double* sum : {&m.xx, &m.xy, &m.yy, &m.xz, &m.yz, &m.zz})
        *sum /= n;
    return m;
}

/// Smallest root of Taubin's characteristic polynomial by Newton's method. Starting at 0 is safe because the
/// iteration approaches the root from one side.
double smallest_root(const CircleMoments& m) {
    const double z = m.xx + m.yy;
    const double det = m.xx * m.yy - m.xy * m.xy;
    const double var_z = m.zz - z * z;
    const double a3 = 4 * z;
    const double a2 = -3 * z * z - m.zz;
    const double a1 = var_z * z + 4 * det * z - m.xz * m.xz - m.yz * m.yz;
    const double a0 = m.xz * (m.xz * m.yy - m.yz * m.xy) + m.yz * (m.yz * m.xx - m.xz * m.xy) - var_z * det;
    double x = 0;
    double y = a0;
    for (int i = 0; i < 40; ++i) {
        const double slope = a1 + x * (2 * a2 + x * 3 * a3);
        const double next = x - y / slope;
        if (!std::isfinite(next) || next == x)
            break;
        const double value = a0 + next * (a1 + next * (a2 + next * a3));
        if (std::abs(value) >= std::abs(y))
            break;
        x = next;
        y = value;
    }
    return x;
}

}  // namespace

std::vector<std::size_t> turning_points(const TraceSums& samples, double tolerance) {
    const std::size_t n = samples.steps();
    std::vector<std::size_t> points;
    points.reserve(32);
    points.push_back(0);
    std::size_t begin = 0;
    while (begin < n) {
        std::size_t end = n;
        // A closed chain begins and ends at the same point, so it is first divided at the point farthest from
        // it.
        if (samples.closed() && begin == 0) {
            double largest = 0;
            samples.for_corners(1, n - 1, [&](std::size_t i, Vec2 corner) {
                if (dot(corner, corner) > largest) {
                    largest = dot(corner, corner);
                    end = i;
                }
                return true;
            });
        }
        end = std::min(end, begin + max_run_span);
        if (end < n || !samples.closed())
            points.push_back(end);
        divide(samples, begin, end, tolerance, points);
        begin = end;
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

std::optional<Circle> fit_circle(const TraceSums& samples, std::size_t first, std::size_t last) {
    const CircleMoments m = moments(samples, first, last);
    const double x = smallest_root(m);
    const double det = x * x - x * (m.xx + m.yy) + m.xx * m.yy - m.xy * m.xy;
    const Vec2 centre{(m.xz * (m.yy - x) - m.yz * m.xy) / det / 2,
                      (m.yz * (m.xx - x) - m.xz * m.xy) / det / 2};
    const double radius = std::sqrt(dot(centre, centre) + m.xx + m.yy);
    if (!std::isfinite(radius) || radius > 1e6)
        return {};
    return Circle{m.mean + centre, radius};
}

std::optional<Circle> circle_through(Vec2 a, Vec2 b, Vec2 c) {
    const Vec2 u = b - a;
    const Vec2 v = c - a;
    const double twice = 2 * cross(u, v);
    const Vec2 centre{(v.y * dot(u, u) - u.y * dot(v, v)) / twice,
                      (u.x * dot(v, v) - v.x * dot(u, u)) / twice};
    const double radius = length(centre);
    if (!std::isfinite(radius) || radius > 1e6)
        return {};
    return Circle{a + centre, radius};
}

}  // namespace d2b::outline

#include "outline/walls/circle.hpp"

#include <cmath>

namespace d2b {
namespace {

/// Central moments of points; z is the squared distance from the mean.
struct CircleMoments {
    Vec mean;
    double xx = 0;
    double xy = 0;
    double yy = 0;
    double xz = 0;
    double yz = 0;
    double zz = 0;
};

CircleMoments moments(const WallSamples& samples, std::size_t first, std::size_t last) {
    CircleMoments m;
    m.mean = samples.sums(first, last).mean;
    for (std::size_t i = first; i < last; ++i) {
        const Vec p = 0.5 * (samples.at(i) + samples.at(i + 1)) - m.mean;
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

std::optional<Circle> fit_circle(const WallSamples& samples, std::size_t first, std::size_t last) {
    const CircleMoments m = moments(samples, first, last);
    const double x = smallest_root(m);
    const double det = x * x - x * (m.xx + m.yy) + m.xx * m.yy - m.xy * m.xy;
    const Vec centre{(m.xz * (m.yy - x) - m.yz * m.xy) / det / 2,
                     (m.yz * (m.xx - x) - m.xz * m.xy) / det / 2};
    const double radius = std::sqrt(dot(centre, centre) + m.xx + m.yy);
    if (!std::isfinite(radius) || radius > 1e6)
        return {};
    return Circle{m.mean + centre, radius};
}

std::optional<Circle> circle_through(Vec a, Vec b, Vec c) {
    const Vec u = b - a;
    const Vec v = c - a;
    const double twice = 2 * cross(u, v);
    const Vec centre{(v.y * dot(u, u) - u.y * dot(v, v)) / twice,
                     (u.x * dot(v, v) - v.x * dot(u, u)) / twice};
    const double radius = length(centre);
    if (!std::isfinite(radius) || radius > 1e6)
        return {};
    return Circle{a + centre, radius};
}

}  // namespace d2b

#include "core/georeference.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace d2b {

Georeference::Georeference(const AffineTransform& transform, TraceMode mode)
    : transform_(transform),
      shift_(mode == TraceMode::points ? 0.5 : 0.0),
      mirrored_(transform[1] * transform[5] - transform[2] * transform[4] > 0) {}

Position Georeference::position(FinePoint point) const {
    // Exact, because the divisor is a power of two.
    const double col = static_cast<double>(point.col) / FinePoint::steps + shift_;
    const double row = static_cast<double>(point.row) / FinePoint::steps + shift_;
    return {transform_[0] + col * transform_[1] + row * transform_[2],
            transform_[3] + col * transform_[4] + row * transform_[5]};
}

Position Georeference::step(double rows, double cols) const {
    return {cols * transform_[1] + rows * transform_[2], cols * transform_[4] + rows * transform_[5]};
}

double Georeference::cell_area() const {
    return std::abs(transform_[1] * transform_[5] - transform_[2] * transform_[4]);
}

bool Georeference::is_exact(const Window& window) const {
    constexpr double roundings = 8;  // more than occur while computing a coordinate
    const auto keeps_apart = [](double origin, double step, std::int64_t steps) {
        const double largest = std::abs(origin) + std::abs(step) * (static_cast<double>(steps) + 1);
        return std::abs(step) > roundings * std::numeric_limits<double>::epsilon() * largest;
    };
    return axis_parallel() &&
           keeps_apart(transform_[0], transform_[1], std::int64_t{window.col} + window.cols) &&
           keeps_apart(transform_[3], transform_[5], std::int64_t{window.row} + window.rows);
}

WorldRing Georeference::corners(const LatticeBox& box) const {
    const auto& [low, high] = box;
    return {position(low), position(LatticePoint{high.row, low.col}), position(high),
            position(LatticePoint{low.row, high.col})};
}

WorldRing Georeference::ring(const FineRing& ring) const {
    WorldRing result;
    result.reserve(ring.size());
    for (const FinePoint point : ring)
        result.push_back(position(point));
    if (mirrored_)
        std::reverse(result.begin() + 1, result.end());
    return result;
}

WorldPolygon Georeference::polygon(const FinePolygon& polygon) const {
    WorldPolygon result{ring(polygon.exterior), {}};
    result.interiors.reserve(polygon.interiors.size());
    for (const FineRing& interior : polygon.interiors)
        result.interiors.push_back(ring(interior));
    result.arcs = polygon.arcs;
    if (mirrored_)
        for (CircularArc& arc : result.arcs) {
            // Reversing a ring about its first vertex turns vertex i into n - i, and an arc then begins at
            // its old end.
            const std::size_t n =
                arc.ring == 0 ? polygon.exterior.size() : polygon.interiors[arc.ring - 1].size();
            arc.first = static_cast<std::uint32_t>((2 * n - arc.first - arc.edges) % n);
        }
    return result;
}

}  // namespace d2b

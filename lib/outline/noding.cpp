#include "outline/noding.hpp"

#include <algorithm>

namespace d2b {
namespace {

LatticePoint turned(LatticePoint point) {
    return {point.col, point.row};
}

void sort_distinct(std::vector<LatticePoint>& points) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
}

}  // namespace

LatticePolygon traced_polygon(const Contour& contour) {
    LatticePolygon polygon{contour.exterior.corners(), {}};
    for (const PackedRing& ring : contour.interiors)
        polygon.interiors.push_back(ring.corners());
    return polygon;
}

CornerIndex::CornerIndex(const std::vector<Contour>& contours) {
    for (const Contour& contour : contours)
        add(contour);
    sort();
}

CornerIndex::CornerIndex(std::span<const Contour* const> contours) {
    for (const Contour* contour : contours)
        add(*contour);
    sort();
}

void CornerIndex::add(const Contour& contour) {
    const auto add_ring = [&](const PackedRing& packed) {
        const LatticeRing ring = packed.corners();
        by_row_.insert(by_row_.end(), ring.begin(), ring.end());
    };
    add_ring(contour.exterior);
    for (const PackedRing& ring : contour.interiors)
        add_ring(ring);
}

void CornerIndex::sort() {
    sort_distinct(by_row_);
    by_col_.reserve(by_row_.size());
    for (const LatticePoint point : by_row_)
        by_col_.push_back(turned(point));
    std::sort(by_col_.begin(), by_col_.end());
}

void CornerIndex::append_between(LatticePoint from, LatticePoint to, LatticeRing& ring) const {
    const bool along_row = from.row == to.row;
    const std::vector<LatticePoint>& points = along_row ? by_row_ : by_col_;
    const LatticePoint a = along_row ? from : turned(from);
    const LatticePoint b = along_row ? to : turned(to);
    const auto begin = std::upper_bound(points.begin(), points.end(), std::min(a, b));
    const auto end = std::lower_bound(begin, points.end(), std::max(a, b));
    const std::size_t old_size = ring.size();
    for (auto point = begin; point != end; ++point)
        ring.push_back(along_row ? *point : turned(*point));
    if (b < a)
        std::reverse(ring.begin() + static_cast<std::ptrdiff_t>(old_size), ring.end());
}

LatticeRing CornerIndex::noded(const LatticeRing& ring) const {
    LatticeRing result;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        result.push_back(ring[i]);
        append_between(ring[i], ring[(i + 1) % ring.size()], result);
    }
    return result;
}

LatticePolygon CornerIndex::noded(const LatticePolygon& polygon) const {
    LatticePolygon result{noded(polygon.exterior), {}};
    for (const LatticeRing& ring : polygon.interiors)
        result.interiors.push_back(noded(ring));
    return result;
}

}  // namespace d2b

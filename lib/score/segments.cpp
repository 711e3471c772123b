#include "score/segments.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace d2b {
namespace {

std::vector<OutlineSegment> segments_of(std::span<const Polyline> lines) {
    std::vector<OutlineSegment> segments;
    for (const Polyline& line : lines)
        for (std::size_t i = 1; i < line.size(); ++i)
            segments.push_back({line[i - 1], line[i]});
    return segments;
}

std::vector<Box> boxes_of(std::span<const OutlineSegment> segments) {
    std::vector<Box> boxes(segments.size());
    for (std::size_t i = 0; i < segments.size(); ++i) {
        boxes[i].add(segments[i].a);
        boxes[i].add(segments[i].b);
    }
    return boxes;
}

}  // namespace

double squared_distance(Position p, const OutlineSegment& segment) {
    const double dx = segment.b.x - segment.a.x;
    const double dy = segment.b.y - segment.a.y;
    const double px = p.x - segment.a.x;
    const double py = p.y - segment.a.y;
    const double length = dx * dx + dy * dy;
    const double t = length > 0 ? std::clamp((px * dx + py * dy) / length, 0.0, 1.0) : 0.0;
    const double x = px - t * dx;
    const double y = py - t * dy;
    return x * x + y * y;
}

Segments::Segments(std::span<const Polyline> lines)
    : segments_(segments_of(lines)), tree_(boxes_of(segments_)) {}

double Segments::distance(Position p, double limit) const {
    return std::sqrt(
        tree_.nearest(p, limit * limit, [&](std::size_t i) { return squared_distance(p, segments_[i]); }));
}

void Segments::within(Position p, double limit, std::vector<OutlineSegment>& found) const {
    found.clear();
    tree_.query({p.x - limit, p.y - limit, p.x + limit, p.y + limit}, [&](std::size_t i) {
        if (squared_distance(p, segments_[i]) < limit * limit)
            found.push_back(segments_[i]);
    });
}

}  // namespace d2b

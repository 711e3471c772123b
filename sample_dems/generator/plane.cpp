#include "plane.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace d2b::sample {

Direction Direction::from_half_tangent(double t) {
    return {(1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)};
}

Position Frame::to_scene(const Position& local) const {
    return {origin.x + x_axis.cosine * local.x - x_axis.sine * local.y,
            origin.y + x_axis.sine * local.x + x_axis.cosine * local.y};
}

Position Frame::to_local(const Position& scene) const {
    const double dx = scene.x - origin.x;
    const double dy = scene.y - origin.y;
    return {x_axis.cosine * dx + x_axis.sine * dy, x_axis.cosine * dy - x_axis.sine * dx};
}

WorldPolygon Frame::to_scene(const WorldPolygon& local) const {
    WorldPolygon placed = local;
    const auto place = [this](WorldRing& ring) {
        for (Position& p : ring)
            p = to_scene(p);
    };
    place(placed.exterior);
    for (WorldRing& ring : placed.interiors)
        place(ring);
    return placed;
}

// std::sqrt is exact to the last bit everywhere, std::hypot is not.
double distance(const Position& a, const Position& b) {
    return std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
}

Position middle(const Position& a, const Position& b) {
    return {(a.x + b.x) / 2, (a.y + b.y) / 2};
}

double left_of(const Position& a, const Position& b, const Position& p) {
    return ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / distance(a, b);
}

double distance_to_segment(const Position& a, const Position& b, const Position& p) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double t = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    return distance({a.x + t * dx, a.y + t * dy}, p);
}

namespace {

bool odd_crossings(const WorldRing& ring, const Position& p) {
    bool inside = false;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        if ((ring[i].y > p.y) == (ring[j].y > p.y))
            continue;
        // Goes from the lower end to the upper one: both houses at a wall compute the same crossing.
        const Position& low = ring[i].y < ring[j].y ? ring[i] : ring[j];
        const Position& high = ring[i].y < ring[j].y ? ring[j] : ring[i];
        if (p.x < low.x + (high.x - low.x) * (p.y - low.y) / (high.y - low.y))
            inside = !inside;
    }
    return inside;
}

}  // namespace

bool contains(const WorldPolygon& polygon, const Position& p) {
    return odd_crossings(polygon.exterior, p) &&
           std::none_of(polygon.interiors.begin(), polygon.interiors.end(),
                        [&p](const WorldRing& hole) { return odd_crossings(hole, p); });
}

Rect bounds(std::span<const Position> positions) {
    Rect box{positions[0].x, positions[0].y, positions[0].x, positions[0].y};
    for (const Position& p : positions)
        box = {std::min(box.x0, p.x), std::min(box.y0, p.y), std::max(box.x1, p.x), std::max(box.y1, p.y)};
    return box;
}

}  // namespace d2b::sample

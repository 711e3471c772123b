#include "geometry/vast_polygons.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>

#include "core/disjoint_sets.hpp"
#include "geometry/box_tree.hpp"

namespace d2b {
namespace {

struct Vertex {
    Position at;
    std::uint32_t ring = 0;

    [[nodiscard]] std::tuple<double, double, std::uint32_t> key() const { return {at.x, at.y, ring}; }
};

bool covers(const Box& outer, const Box& inner) {
    return outer.left <= inner.left && outer.right >= inner.right && outer.low <= inner.low &&
           outer.high >= inner.high;
}

}  // namespace

bool is_vast(const WorldPolygon& polygon) {
    constexpr double most_comparisons = 1e7;  // about 30 ms
    return static_cast<double>(polygon.exterior.size()) * static_cast<double>(polygon.interiors.size()) >
           most_comparisons;
}

std::vector<WorldPolygon> inside_out(const WorldPolygon& polygon) {
    Box frame = box_of(polygon.exterior);
    const double room = frame.right - frame.left + frame.high - frame.low;
    frame = {frame.left - room, frame.low - room, frame.right + room, frame.high + room};
    std::vector<WorldPolygon> result;
    result.reserve(polygon.interiors.size() + 1);
    result.push_back({{{frame.left, frame.low},
                       {frame.right, frame.low},
                       {frame.right, frame.high},
                       {frame.left, frame.high}},
                      {polygon.exterior}});
    for (const WorldRing& ring : polygon.interiors)
        result.push_back({ring, {}});
    return result;
}

/// Rings that touch each other in a cycle, at different points, disconnect the interior.
std::optional<Position> parted_at(const WorldPolygon& polygon) {
    std::vector<Vertex> vertices;
    std::uint32_t rings = 0;
    const auto add = [&](const WorldRing& ring) {
        for (const Position& p : ring)
            vertices.push_back({p, rings});
        ++rings;
    };
    add(polygon.exterior);
    std::ranges::for_each(polygon.interiors, add);
    std::ranges::sort(vertices, {}, &Vertex::key);
    DisjointSets touching(rings);
    for (std::size_t i = 1; i < vertices.size(); ++i) {
        const Vertex& a = vertices[i - 1];
        const Vertex& b = vertices[i];
        if (a.at.x != b.at.x || a.at.y != b.at.y || a.ring == b.ring)
            continue;
        if (touching.find(a.ring) == touching.find(b.ring))
            return b.at;
        touching.join(a.ring, b.ring);
    }
    return {};
}

std::vector<WorldPolygon> without_empty_holes(std::span<const WorldPolygon> polygons) {
    std::vector<Box> boxes;
    boxes.reserve(polygons.size());
    for (const WorldPolygon& polygon : polygons)
        boxes.push_back(box_of(polygon.exterior));
    const BoxTree tree(boxes);
    std::vector<WorldPolygon> result;
    result.reserve(polygons.size());
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        WorldPolygon& kept = result.emplace_back(WorldPolygon{polygons[i].exterior, {}});
        for (const WorldRing& ring : polygons[i].interiors) {
            const Box hole = box_of(ring);
            bool holds = false;
            tree.query(hole, [&](std::size_t other) { holds |= other != i && covers(hole, boxes[other]); });
            if (holds)
                kept.interiors.push_back(ring);
        }
    }
    return result;
}

}  // namespace d2b

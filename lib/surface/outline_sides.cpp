#include "surface/outline_sides.hpp"

#include <algorithm>
#include <cstddef>

#include "geometry/box_tree.hpp"
#include "outline/fine_geometry.hpp"

namespace d2b {
namespace {

/// Exact, because lattices have far fewer than 2^53 steps.
Box box_of(const OutlineSide& side) {
    Box box;
    for (const FinePoint& point : {side.from, side.to})
        box.add(Position{static_cast<double>(point.col), static_cast<double>(point.row)});
    return box;
}

void add_ring(const FineRing& ring, std::uint32_t contour, std::vector<OutlineSide>& sides) {
    for (std::size_t i = 0; i < ring.size(); ++i)
        if (const FinePoint to = ring[i + 1 == ring.size() ? 0 : i + 1]; ring[i] != to)
            sides.push_back({ring[i], to, contour});
}

/// Returns true if a point is in the interior of a side.
bool is_within(const OutlineSide& side, FinePoint point) {
    return point != side.from && point != side.to && boxes_meet({side.from, side.to}, {point, point}) &&
           d2b::side(side.from, side.to, point) == 0;
}

/// Returns true if two sides cross properly, in a point that is not an end of either.
bool cross(const OutlineSide& s, const OutlineSide& t) {
    return side(s.from, s.to, t.from) * side(s.from, s.to, t.to) < 0 &&
           side(t.from, t.to, s.from) * side(t.from, t.to, s.to) < 0;
}

/// Sorts along the direction of a side and removes duplicates.
void sort_along(const OutlineSide& side, std::vector<FinePoint>& points) {
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (side.to < side.from)
        std::ranges::reverse(points);
}

}  // namespace

OutlineSides outline_sides(std::span<const PlanContour> contours) {
    OutlineSides result;
    std::vector<OutlineSide>& sides = result.sides;
    for (std::uint32_t c = 0; c < contours.size(); ++c) {
        add_ring(contours[c].outline.exterior, c, sides);
        for (const FineRing& ring : contours[c].outline.interiors)
            add_ring(ring, c, sides);
    }
    std::vector<Box> boxes(sides.size());
    std::ranges::transform(sides, boxes.begin(), [](const OutlineSide& side) { return box_of(side); });
    const BoxTree tree(boxes);
    result.cuts.resize(sides.size());
    for (std::size_t i = 0; i < sides.size(); ++i) {
        tree.query(boxes[i], [&](std::size_t k) {
            if (is_within(sides[i], sides[k].from))
                result.cuts[i].push_back(sides[k].from);
            if (i < k && cross(sides[i], sides[k]))
                result.crossing.emplace_back(sides[i].contour, sides[k].contour);
        });
        sort_along(sides[i], result.cuts[i]);
    }
    return result;
}

}  // namespace d2b

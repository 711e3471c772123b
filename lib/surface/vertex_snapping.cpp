#include "surface/vertex_snapping.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>

#include "core/for_rings.hpp"
#include "core/int128.hpp"
#include "geometry/box_tree.hpp"
#include "outline/fine_geometry.hpp"
#include "surface/partition.hpp"
#include "surface/partition_editor.hpp"

namespace d2b::surface {
namespace {

constexpr int most_snapping_rounds = 4;

/// Returns the projection of a point onto a b, times the length of a b.
Int128 along(FinePoint a, FinePoint b, FinePoint point) {
    return static_cast<Int128>(b.row - a.row) * (point.row - a.row) +
           static_cast<Int128>(b.col - a.col) * (point.col - a.col);
}

/// Returns true if a point projects into the interior of a b and is within a step of it.
bool is_near(FinePoint a, FinePoint b, FinePoint point) {
    const Int128 square = along(a, b, b);
    const Int128 way = along(a, b, point);
    const Int128 off = outline::turn(a, b, point);
    return way > 0 && way < square && off * off <= square;
}

/// Spatial index of all vertices.
class Corners {
  public:
    explicit Corners(const std::vector<PartitionContour>& contours)
        : points_(points_of(contours)), tree_(boxes()) {}

    /// Returns the ring with all vertices within a step of it inserted.
    [[nodiscard]] FineRing routed_through(const FineRing& ring) const;

  private:
    static std::vector<FinePoint> points_of(const std::vector<PartitionContour>& contours);
    static Box box_of(FinePoint point, double margin) {
        const auto x = static_cast<double>(point.col);
        const auto y = static_cast<double>(point.row);
        return {x - margin, y - margin, x + margin, y + margin};
    }
    [[nodiscard]] std::vector<Box> boxes() const {
        std::vector<Box> boxes;
        boxes.reserve(points_.size());
        for (const FinePoint& point : points_)
            boxes.push_back(box_of(point, 0));
        return boxes;
    }
    [[nodiscard]] std::vector<FinePoint> beside(FinePoint from, FinePoint to) const;

    std::vector<FinePoint> points_;
    BoxTree tree_;
};

std::vector<FinePoint> Corners::points_of(const std::vector<PartitionContour>& contours) {
    std::vector<FinePoint> points;
    for (const PartitionContour& contour : contours)
        for_rings(contour.outline,
                  [&](const FineRing& ring) { points.insert(points.end(), ring.begin(), ring.end()); });
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

/// Returns vertices near a segment in its direction; the same for both directions.
std::vector<FinePoint> Corners::beside(FinePoint from, FinePoint to) const {
    const FinePoint a = std::min(from, to);
    const FinePoint b = std::max(from, to);
    std::vector<std::pair<Int128, FinePoint>> found;
    Box box = box_of(a, 1);
    box.add(box_of(b, 1));
    tree_.query(box, [&](std::size_t i) {
        if (is_near(a, b, points_[i]))
            found.emplace_back(along(a, b, points_[i]), points_[i]);
    });
    std::ranges::sort(found);
    std::vector<FinePoint> points;
    points.reserve(found.size());
    for (const auto& [way, point] : found)
        points.push_back(point);
    if (to < from)
        std::ranges::reverse(points);
    return points;
}

FineRing Corners::routed_through(const FineRing& ring) const {
    FineRing led;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const FinePoint to = ring[i + 1 == ring.size() ? 0 : i + 1];
        if (ring[i] == to)
            continue;
        led.push_back(ring[i]);
        const std::vector<FinePoint> between = beside(ring[i], to);
        led.insert(led.end(), between.begin(), between.end());
    }
    return led;
}

/// Removes spikes (a ring that returns the way it came), because a narrow part may have collapsed.
FineRing without_spikes(const FineRing& ring) {
    std::deque<FinePoint> rest;
    for (const FinePoint& point : ring) {
        if (rest.size() > 1 && rest[rest.size() - 2] == point)
            rest.pop_back();
        else
            rest.push_back(point);
    }
    // Spikes across the start of the ring: a, b, ..., b.
    while (rest.size() > 2 && (rest[1] == rest.back() || rest.front() == rest[rest.size() - 2])) {
        if (rest[1] == rest.back())
            rest.pop_front();
        else
            rest.pop_back();
        if (rest.front() == rest.back())
            rest.pop_back();
    }
    return {rest.begin(), rest.end()};
}

bool has_area(const FineRing& ring) {
    return ring.size() > 2;
}

using NodePair = std::pair<std::uint32_t, std::uint32_t>;

std::int64_t floor_divided(std::int64_t number, std::int64_t by) {
    return number / by - (number % by < 0 ? 1 : 0);
}

/// Returns pairs of nodes closer than a gap, each once, lower number first.
std::vector<NodePair> near_pairs(const std::vector<FinePoint>& nodes, const LatticeDistance& gap) {
    struct Boxed {
        std::int64_t row = 0;
        std::int64_t col = 0;
        std::uint32_t node = 0;

        auto operator<=>(const Boxed&) const = default;
    };
    std::vector<Boxed> boxed;
    boxed.reserve(nodes.size());
    for (std::uint32_t node = 0; node < nodes.size(); ++node)
        boxed.push_back(
            {floor_divided(nodes[node].row, gap.rows), floor_divided(nodes[node].col, gap.cols), node});
    std::ranges::sort(boxed);
    std::vector<NodePair> pairs;
    for (const Boxed& one : boxed)
        for (std::int64_t row = one.row; row <= one.row + 1; ++row) {
            auto other = std::ranges::lower_bound(boxed, Boxed{row, one.col - 1, 0});
            for (; other != boxed.end() && other->row == row && other->col <= one.col + 1; ++other)
                if (*other > one && !gap.parts(nodes[one.node], nodes[other->node]))
                    pairs.emplace_back(std::minmax(one.node, other->node));
        }
    std::ranges::sort(pairs);
    return pairs;
}

/// Returns true if high is above low by less than a gap.
bool is_step(std::int64_t low, std::int64_t high, std::int64_t gap) {
    return low < high && high < low + gap;
}

bool is_level(std::int32_t contour, const std::vector<PartitionContour>& contours) {
    return contour != open_ground && !contours[static_cast<std::size_t>(contour)].plane;
}

/// Returns pairs of level contours that share a node and differ in height by less than a gap, lower one
/// first.
std::vector<std::pair<std::size_t, std::size_t>> steps_between(
    const std::vector<std::vector<IncidentEdge>>& around, const std::vector<PartitionContour>& contours,
    std::int64_t gap) {
    std::vector<std::pair<std::size_t, std::size_t>> steps;
    for (const std::vector<IncidentEdge>& arms : around)
        for (const IncidentEdge& low : arms)
            for (const IncidentEdge& high : arms)
                if (is_level(low.left, contours) && is_level(high.left, contours) &&
                    is_step(contours[static_cast<std::size_t>(low.left)].top,
                            contours[static_cast<std::size_t>(high.left)].top, gap))
                    steps.emplace_back(low.left, high.left);
    return steps;
}

/// Returns true if any two heights differ by less than a gap, wherever they are.
bool has_step(const std::vector<PartitionContour>& contours, std::int64_t gap) {
    std::vector<std::int64_t> tops;
    tops.reserve(contours.size());
    for (const PartitionContour& contour : contours)
        tops.push_back(contour.top);
    std::ranges::sort(tops);
    return std::ranges::adjacent_find(
               tops, [&](std::int64_t a, std::int64_t b) { return is_step(a, b, gap); }) != tops.end();
}

}  // namespace

void route_through_vertices(std::vector<PartitionContour>& contours) {
    const Corners corners(contours);
    for (PartitionContour& contour : contours) {
        FinePolygon& outline = contour.outline;
        // An outline that collapsed entirely stays as it was, so that the conflict is reported.
        if (FineRing led = without_spikes(corners.routed_through(outline.exterior)); has_area(led))
            outline.exterior = std::move(led);
        for (FineRing& ring : outline.interiors)
            ring = without_spikes(corners.routed_through(ring));
        std::erase_if(outline.interiors, [](const FineRing& ring) { return !has_area(ring); });
    }
}

void snap_round(std::vector<PartitionContour>& contours) {
    for (int round = 0; round < most_snapping_rounds && !make_partition(contours).conflicting.empty();
         ++round)
        route_through_vertices(contours);
}

void merge_near_nodes(PlanarPartition& plan, const LatticeDistance& gap) {
    const std::vector<NodePair> pairs = near_pairs(plan.nodes, gap);
    if (pairs.empty())
        return;
    PartitionEditor editor(std::move(plan));
    for (const auto& [a, b] : pairs) {
        if (editor.degree(a) == 0 || editor.degree(b) == 0)
            continue;
        // Keep the node with more edges, if possible.
        const bool keep_first = editor.degree(a) >= editor.degree(b);
        const auto [stays, goes] = keep_first ? std::pair(a, b) : std::pair(b, a);
        if (!editor.merge(goes, stays))
            static_cast<void>(editor.merge(stays, goes));
    }
    plan = editor.plan();
}

void level_near_roofs(const PlanarPartition& plan, std::vector<PartitionContour>& contours,
                      std::int64_t gap) {
    if (!has_step(contours, gap))
        return;
    const std::vector<std::vector<IncidentEdge>> around = edges_around_nodes(plan);
    // Terminates, because each round raises a roof to the height of an existing one.
    for (auto steps = steps_between(around, contours, gap); !steps.empty();
         steps = steps_between(around, contours, gap))
        for (const auto& [low, high] : steps)
            contours[low].top = std::max(contours[low].top, contours[high].top);
}

}  // namespace d2b::surface

#include "surface/snap_rounded.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>

#include "core/int128.hpp"
#include "geometry/box_tree.hpp"
#include "outline/fine_geometry.hpp"
#include "surface/partition.hpp"

namespace d2b {
namespace {

constexpr int most_rounds = 4;

/// Returns the projection of a point onto a b, times the length of a b.
Int128 along(FinePoint a, FinePoint b, FinePoint point) {
    return static_cast<Int128>(b.row - a.row) * (point.row - a.row) +
           static_cast<Int128>(b.col - a.col) * (point.col - a.col);
}

/// Returns true if a point projects into the interior of a b and is within a step of it.
bool is_near(FinePoint a, FinePoint b, FinePoint point) {
    const Int128 square = along(a, b, b);
    const Int128 way = along(a, b, point);
    const Int128 off = turn(a, b, point);
    return way > 0 && way < square && off * off <= square;
}

/// Spatial index of all vertices.
class Corners {
  public:
    explicit Corners(const std::vector<PlanContour>& contours)
        : points_(points_of(contours)), tree_(boxes()) {}

    /// Returns the ring with all vertices within a step of it inserted.
    [[nodiscard]] FineRing led_through(const FineRing& ring) const;

  private:
    static std::vector<FinePoint> points_of(const std::vector<PlanContour>& contours);
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

std::vector<FinePoint> Corners::points_of(const std::vector<PlanContour>& contours) {
    std::vector<FinePoint> points;
    for (const PlanContour& contour : contours) {
        points.insert(points.end(), contour.outline.exterior.begin(), contour.outline.exterior.end());
        for (const FineRing& ring : contour.outline.interiors)
            points.insert(points.end(), ring.begin(), ring.end());
    }
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

/// Returns vertices near a segment in its direction; the same for both directions.
std::vector<FinePoint> Corners::beside(FinePoint from, FinePoint to) const {
    const auto [a, b] = std::minmax(from, to);
    std::vector<std::pair<Int128, FinePoint>> found;
    Box box = box_of(a, 1);
    box.add(box_of(b, 1));
    tree_.query(box, [&, a = a, b = b](std::size_t i) {
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

FineRing Corners::led_through(const FineRing& ring) const {
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

}  // namespace

void snap_rounded(std::vector<PlanContour>& contours) {
    for (int round = 0; round < most_rounds && !make_partition(contours).at_odds.empty(); ++round) {
        const Corners corners(contours);
        for (PlanContour& contour : contours) {
            FinePolygon& outline = contour.outline;
            // An outline that collapsed entirely stays as it was, so that the conflict is reported.
            if (FineRing led = without_spikes(corners.led_through(outline.exterior)); has_area(led))
                outline.exterior = std::move(led);
            for (FineRing& ring : outline.interiors)
                ring = without_spikes(corners.led_through(ring));
            std::erase_if(outline.interiors, [](const FineRing& ring) { return !has_area(ring); });
        }
    }
}

}  // namespace d2b

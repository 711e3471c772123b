#include "score/shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "score/measure.hpp"

namespace d2b::score {
namespace {

constexpr double quarter = 90;
constexpr double right_angle = 90;
/// In degrees and metres: far above rounding errors of coordinates. Keeps exact limits, which walls on the
/// borders of cells have, from being undercut.
constexpr double rounding_error = 1e-6;

double degrees_of(double radians) {
    return radians * 180 / std::numbers::pi;
}

struct Edge {
    double direction = 0;  ///< modulo 90 degrees
    double length = 0;
};

/// The edge between two positions.
Edge edge_between(Position from, Position to) {
    const double dx = to.x - from.x;
    const double dy = to.y - from.y;
    const double direction = std::fmod(degrees_of(std::atan2(dy, dx)) + 4 * quarter, quarter);
    return {direction, std::hypot(dx, dy)};
}

/// Angle that the walls at a corner enclose, inside or outside: 0 to 180 degrees.
double enclosed_angle(Position before, Position corner, Position after) {
    const double ax = before.x - corner.x;
    const double ay = before.y - corner.y;
    const double bx = after.x - corner.x;
    const double by = after.y - corner.y;
    return degrees_of(std::abs(std::atan2(ax * by - ay * bx, ax * bx + ay * by)));
}

std::vector<Edge> edges_of(const CornerRings& polygon) {
    std::vector<Edge> edges;
    for (const WorldRing& ring : polygon)
        for (std::size_t i = 0; i < ring.size(); ++i)
            edges.push_back(edge_between(ring[i], ring[(i + 1) % ring.size()]));
    return edges;
}

/// Sums of the lengths of edges within ranges of directions.
class LengthsByDirection {
  public:
    explicit LengthsByDirection(std::vector<Edge> edges) {
        std::ranges::sort(edges, {}, &Edge::direction);
        // Three times, because directions just below 90 degrees are next to those just above 0.
        for (const double turn : {-quarter, 0.0, quarter})
            for (const Edge& edge : edges) {
                directions_.push_back(edge.direction + turn);
                sums_.push_back(sums_.back() + edge.length);
            }
    }
    /// Length of edges with directions less than `near_deg` from one.
    [[nodiscard]] double near(double direction, double near_deg) const {
        const auto low = std::ranges::upper_bound(directions_, direction - near_deg);
        const auto high = std::ranges::lower_bound(directions_, direction + near_deg);
        return sums_[index(high)] - sums_[index(low)];
    }

  private:
    [[nodiscard]] std::size_t index(std::vector<double>::const_iterator at) const {
        return static_cast<std::size_t>(at - directions_.begin());
    }

    std::vector<double> directions_;
    std::vector<double> sums_{0.0};  ///< of the edges before each, and of all
};

/// Counts of one side, from which the shares follow.
class ShapeCounter {
  public:
    explicit ShapeCounter(const ShapeLimits& limits) : limits_(limits) {}

    void add(const CornerRings& polygon) {
        ++polygons_;
        for (const WorldRing& ring : polygon)
            for (std::size_t i = 0; i < ring.size(); ++i)
                add_corner(ring[(i + ring.size() - 1) % ring.size()], ring[i], ring[(i + 1) % ring.size()]);
        const MainDirection direction = main_direction(polygon, limits_.near_deg);
        along_ += direction.along;
        length_ += direction.length;
    }

    [[nodiscard]] ShapeScore result() const {
        ShapeScore score;
        score.polygons = polygons_;
        score.corners = corners_;
        score.corners_per_building = share(corners_, polygons_);
        score.right_share = share(right_, corners_);
        score.sharp45_share = share(sharp_, corners_);
        score.along_share = share(along_, length_);
        if (limits_.short_edge)
            score.short_edge_share = share(short_, corners_);  // a ring has as many edges as corners
        return score;
    }

  private:
    void add_corner(Position before, Position corner, Position after) {
        const double angle = enclosed_angle(before, corner, after);
        ++corners_;
        if (std::abs(angle - right_angle) < limits_.near_deg - rounding_error)
            ++right_;
        if (angle < limits_.sharp_deg - rounding_error)
            ++sharp_;
        if (limits_.short_edge &&
            std::hypot(after.x - corner.x, after.y - corner.y) < *limits_.short_edge - rounding_error)
            ++short_;
    }

    ShapeLimits limits_;
    std::size_t polygons_ = 0;
    std::size_t corners_ = 0;
    std::size_t right_ = 0;
    std::size_t sharp_ = 0;
    std::size_t short_ = 0;
    double along_ = 0;
    double length_ = 0;
};

/// @param sorted not empty
double percentile(std::span<const double> sorted, double share_below) {
    const double rank = share_below * static_cast<double>(sorted.size() - 1);
    const auto low = static_cast<std::size_t>(rank);
    const std::size_t high = std::min(low + 1, sorted.size() - 1);
    return std::lerp(sorted[low], sorted[high], rank - static_cast<double>(low));
}

}  // namespace

WorldRing from_leftmost(const WorldRing& ring) {
    WorldRing result = ring;
    const auto first =
        std::ranges::min_element(result, {}, [](const Position& p) { return std::pair(p.x, p.y); });
    std::rotate(result.begin(), first, result.end());
    return result;
}

MainDirection main_direction(const CornerRings& polygon, double near_deg) {
    const std::vector<Edge> edges = edges_of(polygon);
    const LengthsByDirection lengths(edges);
    MainDirection main;
    double longest = 0;
    for (const Edge& edge : edges) {
        main.length += edge.length;
        const double along = lengths.near(edge.direction, near_deg);
        // Edges near each other often have the same sum, up to its rounding.
        const double tie = rounding_error * main.along;
        if (along < main.along - tie || (along <= main.along + tie && edge.length <= longest))
            continue;
        main.degrees = edge.direction;
        main.along = along;
        longest = edge.length;
    }
    return main;
}

double angle_between(double degrees, double other_degrees) {
    const double angle = std::fmod(std::abs(degrees - other_degrees), quarter);
    return std::min(angle, quarter - angle);
}

ShapeScore measure_shape(std::span<const CornerRings> polygons, const ShapeLimits& limits) {
    ShapeCounter counter(limits);
    for (const CornerRings& polygon : polygons)
        counter.add(polygon);
    return counter.result();
}

std::optional<DirectionErrors> direction_errors(std::vector<double> angles) {
    if (angles.empty())
        return std::nullopt;
    std::ranges::sort(angles);
    return DirectionErrors{angles.size(), percentile(angles, 0.5), percentile(angles, 0.9)};
}

}  // namespace d2b::score

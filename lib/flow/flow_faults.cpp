#include "flow/flow_faults.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "outline/fine_geometry.hpp"

namespace d2b {
namespace {

/// Whether a direction is strictly within the sector on the left of the first of two arms.
bool is_in_sector(FinePoint node, FinePoint first, FinePoint second, FinePoint to) {
    if (side(node, first, second) > 0)
        return side(node, first, to) > 0 && side(node, to, second) > 0;
    const bool in_the_rest = side(node, second, to) >= 0 && side(node, to, first) >= 0;
    return !in_the_rest || (side(node, first, second) == 0 && side(node, first, to) > 0);
}

class FaultFinder {
  public:
    FaultFinder(const PlanEditor& plan, std::span<const PlanContour> contours, const FlowLimits& limits)
        : plan_(plan), contours_(contours), limits_(limits) {}

    [[nodiscard]] std::vector<FlowFault> find();

  private:
    void look_along(std::uint32_t first, std::uint32_t next);
    void look_at_wall(std::uint32_t edge);
    void look_at_angles(std::uint32_t node, const std::vector<NodeArm>& arms);
    void look_across(std::uint32_t node, const std::vector<NodeArm>& arms);
    void look_at_gap(std::uint32_t node, const std::vector<NodeArm>& arms, std::uint32_t edge);
    [[nodiscard]] bool runs_on(std::uint32_t node) const;
    [[nodiscard]] bool ends_a_gap(const PlanEdge& edge) const;
    [[nodiscard]] bool is_above(std::int32_t contour, std::int32_t floor) const;
    [[nodiscard]] bool is_seen(std::uint32_t node, const FlowFault& gap) const;
    [[nodiscard]] double angle(FinePoint node, FinePoint first, FinePoint second) const;

    const PlanEditor& plan_;
    std::span<const PlanContour> contours_;
    const FlowLimits& limits_;
    std::vector<FlowFault> faults_;
};

bool FaultFinder::is_above(std::int32_t contour, std::int32_t floor) const {
    while (contour != open_ground && contour != floor) {
        contour = contours_[static_cast<std::size_t>(contour)].parent;
        if (contour == floor)
            return true;
    }
    return false;
}

/// Degrees from the first direction to the second, counter-clockwise on the ground.
double FaultFinder::angle(FinePoint node, FinePoint first, FinePoint second) const {
    const FlowMetric& m = limits_.metric;
    const double x1 = m.x(node, first);
    const double y1 = m.y(node, first);
    const double x2 = m.x(node, second);
    const double y2 = m.y(node, second);
    return std::abs(std::atan2(x1 * y2 - y1 * x2, x1 * x2 + y1 * y2)) * 180 / std::numbers::pi;
}

/// Whether a node is but a place on a straight wall. Nothing but rounding bends it.
bool FaultFinder::runs_on(std::uint32_t node) const {
    constexpr double straight = 0.5;  // degrees
    if (plan_.degree(node) != 2)
        return false;
    const std::vector<NodeArm> arms = plan_.around(node);
    return angle(plan_.at(node), plan_.at(arms[0].end), plan_.at(arms[1].end)) > 180 - straight;
}

/// Whether the walls at both ends run on along a lower place, with it between them: its width is that of the
/// edge.
bool FaultFinder::ends_a_gap(const PlanEdge& edge) const {
    for (const auto& [from, to, floor, above] : {std::tuple(edge.from, edge.to, edge.left, edge.right),
                                                 std::tuple(edge.to, edge.from, edge.right, edge.left)}) {
        if (!is_above(above, floor) || plan_.degree(from) != 2 || plan_.degree(to) != 2)
            continue;
        const auto next = [&](std::uint32_t node, std::uint32_t known) {
            const std::vector<NodeArm> arms = plan_.around(node);
            return plan_.at(arms[0].end == known ? arms[1].end : arms[0].end);
        };
        const FinePoint a = plan_.at(from);
        const FinePoint b = plan_.at(to);
        const FinePoint before = next(from, to);
        const FinePoint after = next(to, from);
        constexpr double widest = 120;  // degrees
        if (side(a, b, before) > 0 && side(a, b, after) > 0 && angle(a, b, before) < widest &&
            angle(b, a, after) < widest)
            return true;
    }
    return false;
}

/// From the first corner of a wall on, through places where it but runs on.
void FaultFinder::look_along(std::uint32_t first, std::uint32_t next) {
    const auto way = [&](std::uint32_t a, std::uint32_t b) {
        return limits_.metric.distance(plan_.at(a), plan_.at(b));
    };
    double length = way(first, next);
    std::uint32_t before = first;
    std::uint32_t last = next;
    while (length < limits_.wall && runs_on(last)) {
        const std::vector<NodeArm> arms = plan_.around(last);
        const std::uint32_t after = arms[arms[0].end == before ? 1 : 0].end;
        before = std::exchange(last, after);
        length += way(before, last);
    }
    if (length < limits_.wall && first < last)
        faults_.push_back({FlowKind::wall, first, next, 0, length, {}});
}

void FaultFinder::look_at_wall(std::uint32_t edge) {
    const PlanEdge& e = plan_.edges()[edge];
    if (!runs_on(e.from))
        look_along(e.from, e.to);
    if (!runs_on(e.to))
        look_along(e.to, e.from);
    const double length = limits_.metric.distance(plan_.at(e.from), plan_.at(e.to));
    if (length >= limits_.wall && length < limits_.gap && ends_a_gap(e))
        faults_.push_back({FlowKind::wall, e.from, e.to, 0, length, {}});
}

void FaultFinder::look_at_angles(std::uint32_t node, const std::vector<NodeArm>& arms) {
    for (std::size_t i = 0; i < arms.size() && arms.size() > 1; ++i) {
        const NodeArm& next = arms[(i + 1) % arms.size()];
        const double degrees = angle(plan_.at(node), plan_.at(arms[i].end), plan_.at(next.end));
        if (degrees < limits_.angle && (arms.size() > 2 || i == 0))
            faults_.push_back({FlowKind::angle, node, arms[i].end, next.end, degrees, {}});
    }
}

/// Whether nothing lies between a node and the place of a gap.
bool FaultFinder::is_seen(std::uint32_t node, const FlowFault& gap) const {
    const FinePoint from = plan_.at(node);
    const FinePoint to = gap.place;
    bool seen = true;
    plan_.near({std::min(from.row, to.row), std::min(from.col, to.col)},
               {std::max(from.row, to.row), std::max(from.col, to.col)}, [&](std::uint32_t e) {
                   const PlanEdge& edge = plan_.edges()[e];
                   if (!seen || e == gap.one)
                       return;
                   const FinePoint a = plan_.at(edge.from);
                   const FinePoint b = plan_.at(edge.to);
                   if (edge.from == node || edge.to == node)
                       seen = !overlap_from(from, to, edge.from == node ? b : a);
                   else if (a == to || b == to)
                       seen = !overlap_from(to, from, a == to ? b : a);
                   else
                       seen = !meet({a, b}, {from, to});
               });
    return seen;
}

void FaultFinder::look_at_gap(std::uint32_t node, const std::vector<NodeArm>& arms, std::uint32_t edge) {
    const PlanEdge& e = plan_.edges()[edge];
    if (e.from == node || e.to == node)
        return;
    const FlowMetric& m = limits_.metric;
    const FinePoint p = plan_.at(node);
    const FinePoint a = plan_.at(e.from);
    const FinePoint b = plan_.at(e.to);
    const double along =
        (m.x(a, p) * m.x(a, b) + m.y(a, p) * m.y(a, b)) / (m.x(a, b) * m.x(a, b) + m.y(a, b) * m.y(a, b));
    const double share = std::clamp(along, 0.0, 1.0);
    const FinePoint place{a.row + std::llround(share * static_cast<double>(b.row - a.row)),
                          a.col + std::llround(share * static_cast<double>(b.col - a.col))};
    const double width = m.distance(p, place);
    if (!(width < limits_.gap) || place == p)
        return;
    for (const NodeArm& arm : arms) {
        if (arm.end == e.from || arm.end == e.to)
            return;  // a wedge
    }
    for (std::size_t i = 0; i < arms.size(); ++i) {
        const NodeArm& next = arms[(i + 1) % arms.size()];
        if (arms.size() > 1 && !is_in_sector(p, plan_.at(arms[i].end), plan_.at(next.end), place))
            continue;
        const std::int32_t floor = arms[i].left;
        const bool from_left = e.left == floor;
        const std::int32_t across = from_left ? e.right : e.left;
        const FlowFault fault{FlowKind::gap, node, edge, 0, width, place};
        if ((from_left || e.right == floor) && is_above(across, floor) && is_above(arms[i].right, floor) &&
            is_above(next.left, floor) && is_seen(node, fault))
            faults_.push_back(fault);
        return;
    }
}

void FaultFinder::look_across(std::uint32_t node, const std::vector<NodeArm>& arms) {
    const FlowMetric& m = limits_.metric;
    const std::int64_t reach = m.steps_around(limits_.gap);
    const FinePoint p = plan_.at(node);
    std::vector<std::uint32_t> edges;
    plan_.near({p.row - reach, p.col - reach}, {p.row + reach, p.col + reach},
               [&](std::uint32_t e) { edges.push_back(e); });
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    const std::size_t known = faults_.size();
    for (const std::uint32_t e : edges)
        look_at_gap(node, arms, e);
    // Next to a corner two edges are near; the narrowest place says it all.
    if (faults_.size() > known + 1) {
        const auto first = faults_.begin() + static_cast<std::ptrdiff_t>(known);
        std::swap(*first, *std::min_element(first, faults_.end(), [](const FlowFault& a, const FlowFault& b) {
            return a.size < b.size;
        }));
        faults_.resize(known + 1);
    }
}

std::vector<FlowFault> FaultFinder::find() {
    for (std::uint32_t e = 0; e < plan_.edges().size(); ++e)
        if (plan_.is_edge(e))
            look_at_wall(e);
    for (std::uint32_t node = 0; node < plan_.nodes().size(); ++node)
        if (plan_.degree(node) > 0) {
            const std::vector<NodeArm> arms = plan_.around(node);
            look_at_angles(node, arms);
            look_across(node, arms);
        }
    return std::move(faults_);
}

}  // namespace

std::vector<FlowFault> find_faults(const PlanEditor& plan, std::span<const PlanContour> contours,
                                   const FlowLimits& limits) {
    return FaultFinder(plan, contours, limits).find();
}

}  // namespace d2b

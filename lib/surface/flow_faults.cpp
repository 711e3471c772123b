#include "surface/flow_faults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "outline/fine_geometry.hpp"

namespace d2b::surface {
namespace {

/// Returns true if a direction is strictly within the sector to the left of the first of two arms.
bool is_in_sector(FinePoint node, FinePoint first, FinePoint second, FinePoint to) {
    if (outline::side(node, first, second) > 0)
        return outline::side(node, first, to) > 0 && outline::side(node, to, second) > 0;
    const bool in_the_rest = outline::side(node, second, to) >= 0 && outline::side(node, to, first) >= 0;
    return !in_the_rest || (outline::side(node, first, second) == 0 && outline::side(node, first, to) > 0);
}

void erase_if_marked(std::vector<KnownFault>& known, const std::vector<bool>& marked) {
    std::erase_if(known, [&](const KnownFault& fault) { return marked[fault.found_at]; });
}

/// Marks removed edges, so that their faults are erased.
void mark_removed(const std::vector<KnownFault>& walls, const PartitionEditor& plan,
                  std::vector<bool>& marked) {
    for (const KnownFault& wall : walls)
        if (!plan.is_edge(wall.found_at))
            marked[wall.found_at] = true;
}

/// Merges two lists that are sorted by place.
void merge_in(std::vector<KnownFault>& known, std::vector<KnownFault>&& more) {
    std::vector<KnownFault> all;
    all.reserve(known.size() + more.size());
    std::ranges::merge(known, more, std::back_inserter(all), {}, &KnownFault::found_at,
                       &KnownFault::found_at);
    known = std::move(all);
}

/// Drops the second of two faults that are one narrow place, found from the corners on both sides of it.
void drop_mirrored(std::vector<FlowFault>& faults, const PartitionEditor& plan) {
    std::set<std::tuple<FlowKind, FinePoint, FinePoint>> known;
    std::erase_if(faults, [&](const FlowFault& fault) {
        if (fault.kind != FlowKind::gap && fault.kind != FlowKind::neck)
            return false;
        known.insert({fault.kind, plan.at(fault.node), fault.place});
        return known.contains({fault.kind, fault.place, plan.at(fault.node)});
    });
}

}  // namespace

/// Finds the faults at one edge or node.
class FlowFaults::Finder {
  public:
    Finder(const PartitionEditor& plan, std::span<const PartitionContour> contours, const FlowLimits& limits)
        : plan_(plan), contours_(contours), limits_(limits) {}

    [[nodiscard]] std::vector<FlowFault> at_edge(std::uint32_t edge);
    [[nodiscard]] std::vector<FlowFault> at_node(std::uint32_t node);
    /// Distance in m from the last node within which edges affect the result there.
    [[nodiscard]] double reach() const { return reach_; }

  private:
    void look_along(std::uint32_t first, std::uint32_t next);
    void look_at_angles(std::uint32_t node, const std::vector<IncidentEdge>& arms);
    void look_across(std::uint32_t node, const std::vector<IncidentEdge>& arms);
    [[nodiscard]] std::optional<FlowKind> kind_between(const PartitionEdge& edge, const IncidentEdge& first,
                                                       const IncidentEdge& second, double width) const;
    [[nodiscard]] std::optional<FlowFault> narrow_to(std::uint32_t edge, std::uint32_t node,
                                                     const std::vector<IncidentEdge>& arms) const;
    [[nodiscard]] bool runs_on(std::uint32_t node) const;
    [[nodiscard]] bool ends_a_gap(const PartitionEdge& edge) const;
    [[nodiscard]] bool is_above(std::int32_t contour, std::int32_t floor) const {
        return contour != floor && is_on(contour, floor, contours_);
    }
    [[nodiscard]] bool is_seen(const FlowFault& narrow) const;
    [[nodiscard]] double angle(FinePoint node, FinePoint first, FinePoint second) const;

    const PartitionEditor& plan_;
    std::span<const PartitionContour> contours_;
    const FlowLimits& limits_;
    std::vector<FlowFault> faults_;
    std::vector<std::uint32_t> seen_at_;  // last search that met each edge
    std::uint32_t look_ = 0;
    double reach_ = 0;
};

/// Degrees from the first direction to the second, counter-clockwise on the ground.
double FlowFaults::Finder::angle(FinePoint node, FinePoint first, FinePoint second) const {
    const Vec2 a = limits_.metric.way(node, first);
    const Vec2 b = limits_.metric.way(node, second);
    return std::abs(std::atan2(cross(a, b), dot(a, b))) * 180 / std::numbers::pi;
}

/// Returns true if a wall goes straight on at a node, apart from rounding.
bool FlowFaults::Finder::runs_on(std::uint32_t node) const {
    constexpr double straight = 0.5;  // degrees
    if (plan_.degree(node) != 2)
        return false;
    const std::vector<IncidentEdge> arms = plan_.at_node(node);
    return angle(plan_.at(node), plan_.at(arms[0].end), plan_.at(arms[1].end)) > 180 - straight;
}

/// Returns true if the walls at both ends of an edge go on along a lower place between them, because its
/// width is then the length of the edge.
bool FlowFaults::Finder::ends_a_gap(const PartitionEdge& edge) const {
    for (const auto& [from, to, floor, above] : {std::tuple(edge.from, edge.to, edge.left, edge.right),
                                                 std::tuple(edge.to, edge.from, edge.right, edge.left)}) {
        if (!is_above(above, floor) || plan_.degree(from) != 2 || plan_.degree(to) != 2)
            continue;
        const auto next = [&](std::uint32_t node, std::uint32_t known) {
            const std::vector<IncidentEdge> arms = plan_.at_node(node);
            return plan_.at(arms[0].end == known ? arms[1].end : arms[0].end);
        };
        const FinePoint a = plan_.at(from);
        const FinePoint b = plan_.at(to);
        const FinePoint before = next(from, to);
        const FinePoint after = next(to, from);
        constexpr double widest = 120;  // degrees
        if (outline::side(a, b, before) > 0 && outline::side(a, b, after) > 0 &&
            angle(a, b, before) < widest && angle(b, a, after) < widest)
            return true;
    }
    return false;
}

/// Measures a wall from its first corner, past nodes at which it goes straight on.
void FlowFaults::Finder::look_along(std::uint32_t first, std::uint32_t next) {
    const auto way = [&](std::uint32_t a, std::uint32_t b) {
        return limits_.metric.distance(plan_.at(a), plan_.at(b));
    };
    double length = way(first, next);
    std::uint32_t before = first;
    std::uint32_t last = next;
    while (length < limits_.wall && runs_on(last)) {
        const std::vector<IncidentEdge> arms = plan_.at_node(last);
        const std::uint32_t after = arms[arms[0].end == before ? 1 : 0].end;
        before = std::exchange(last, after);
        length += way(before, last);
    }
    if (length < limits_.wall && first < last)
        faults_.push_back({FlowKind::wall, first, next, 0, length, {}});
}

std::vector<FlowFault> FlowFaults::Finder::at_edge(std::uint32_t edge) {
    const PartitionEdge& e = plan_.edges()[edge];
    if (!runs_on(e.from))
        look_along(e.from, e.to);
    if (!runs_on(e.to))
        look_along(e.to, e.from);
    const double length = limits_.metric.distance(plan_.at(e.from), plan_.at(e.to));
    if (length >= limits_.wall && length < limits_.gap && ends_a_gap(e))
        faults_.push_back({FlowKind::wall, e.from, e.to, 0, length, {}});
    return std::exchange(faults_, {});
}

void FlowFaults::Finder::look_at_angles(std::uint32_t node, const std::vector<IncidentEdge>& arms) {
    for (std::size_t i = 0; i < arms.size() && arms.size() > 1; ++i) {
        const IncidentEdge& next = arms[(i + 1) % arms.size()];
        const double degrees = angle(plan_.at(node), plan_.at(arms[i].end), plan_.at(next.end));
        if (degrees < limits_.angle && (arms.size() > 2 || i == 0))
            faults_.push_back({FlowKind::angle, node, arms[i].end, next.end, degrees, {}});
    }
}

/// True if nothing lies between a node and the place of a gap or neck.
bool FlowFaults::Finder::is_seen(const FlowFault& narrow) const {
    const FinePoint from = plan_.at(narrow.node);
    const FinePoint to = narrow.place;
    const FinePoint low{std::min(from.row, to.row), std::min(from.col, to.col)};
    const FinePoint high{std::max(from.row, to.row), std::max(from.col, to.col)};
    return plan_.all_near(low, high, [&](std::uint32_t e) {
        if (e == narrow.one)
            return true;
        const PartitionEdge& edge = plan_.edges()[e];
        const FinePoint a = plan_.at(edge.from);
        const FinePoint b = plan_.at(edge.to);
        if (edge.from == narrow.node || edge.to == narrow.node)
            return !outline::overlap_from(from, to, edge.from == narrow.node ? b : a);
        if (a == to || b == to)
            return !outline::overlap_from(to, from, a == to ? b : a);
        return !outline::segments_intersect({a, b}, {from, to});
    });
}

/// Classifies a narrow place between an edge and the sector between two edges of a node; none if they do not
/// border on the same contour, or the place is wide enough.
std::optional<FlowKind> FlowFaults::Finder::kind_between(const PartitionEdge& edge, const IncidentEdge& first,
                                                         const IncidentEdge& second, double width) const {
    const std::int32_t between = first.left;
    const bool is_left = edge.left == between;
    if (!is_left && edge.right != between)
        return std::nullopt;
    const std::array around{is_left ? edge.right : edge.left, first.right, second.left};
    const auto is_higher = [&](std::int32_t other) { return is_above(other, between); };
    if (width < limits_.gap && std::ranges::all_of(around, is_higher))
        return FlowKind::gap;
    if (width < limits_.wall && std::ranges::none_of(around, is_higher))
        return FlowKind::neck;
    return std::nullopt;
}

/// Returns the gap or neck between a node and an edge, even if other edges cross it.
std::optional<FlowFault> FlowFaults::Finder::narrow_to(std::uint32_t edge, std::uint32_t node,
                                                       const std::vector<IncidentEdge>& arms) const {
    const PartitionEdge& e = plan_.edges()[edge];
    if (e.from == node || e.to == node)
        return std::nullopt;
    const FlowMetric& m = limits_.metric;
    const FinePoint p = plan_.at(node);
    const FinePoint a = plan_.at(e.from);
    const FinePoint b = plan_.at(e.to);
    if (std::ranges::none_of(
            arms, [&](const IncidentEdge& arm) { return arm.left == e.left || arm.left == e.right; }))
        return std::nullopt;  // no sector of the node faces it
    const FinePoint place = outline::point_between(a, b, m.nearest_share(p, a, b));
    const double width = m.distance(p, place);
    if (!(width < std::max(limits_.gap, limits_.wall)) || place == p)
        return std::nullopt;
    for (const IncidentEdge& arm : arms) {
        if (arm.end == e.from || arm.end == e.to)
            return std::nullopt;  // a wedge
    }
    for (std::size_t i = 0; i < arms.size(); ++i) {
        const IncidentEdge& next = arms[(i + 1) % arms.size()];
        if (arms.size() > 1 && !is_in_sector(p, plan_.at(arms[i].end), plan_.at(next.end), place))
            continue;
        const auto kind = kind_between(e, arms[i], next, width);
        return kind ? std::optional(FlowFault{*kind, node, edge, 0, width, place}) : std::nullopt;
    }
    return std::nullopt;
}

/// Finds the narrowest gap and the narrowest neck at a corner, because wider ones there are their
/// continuation. Searches from the node outwards, because most edges within the limit lie behind the nearest
/// one.
void FlowFaults::Finder::look_across(std::uint32_t node, const std::vector<IncidentEdge>& arms) {
    const double limit = std::max(limits_.gap, limits_.wall);
    reach_ = limit;
    if (!(limit > 0))
        return;
    const FinePoint p = plan_.at(node);
    seen_at_.resize(plan_.edges().size());
    ++look_;
    std::vector<FlowFault> found;
    bool wants_gap = limits_.gap > 0;
    bool wants_neck = limits_.wall > 0;
    for (const double share : {0.125, 0.35, 1.0}) {
        const std::int64_t reach = limits_.metric.steps_around(share * limit);
        const auto look = [&](std::uint32_t e) {
            if (std::exchange(seen_at_[e], look_) != look_)
                if (const auto narrow = narrow_to(e, node, arms))
                    found.push_back(*narrow);
            return true;
        };
        static_cast<void>(
            plan_.all_near({p.row - reach, p.col - reach}, {p.row + reach, p.col + reach}, look));
        std::ranges::sort(
            found, {}, [](const FlowFault& fault) { return std::tuple(fault.size, fault.place, fault.one); });
        const auto beyond =
            std::ranges::find_if(found, [&](const FlowFault& fault) { return fault.size > share * limit; });
        for (auto fault = found.begin(); fault != beyond; ++fault) {
            bool& wanted = fault->kind == FlowKind::gap ? wants_gap : wants_neck;
            if (!wanted || !is_seen(*fault))
                continue;
            wanted = false;
            faults_.push_back(*fault);
            if (!wants_gap && !wants_neck) {
                reach_ = fault->size;
                return;
            }
        }
        found.erase(found.begin(), beyond);
    }
}

std::vector<FlowFault> FlowFaults::Finder::at_node(std::uint32_t node) {
    const std::vector<IncidentEdge> arms = plan_.around(node);
    look_at_angles(node, arms);
    look_across(node, arms);
    return std::exchange(faults_, {});
}

FlowFaults::FlowFaults(const PartitionEditor& plan, std::span<const PartitionContour> contours,
                       const FlowLimits& limits, const StopToken& stop)
    : plan_(plan), limits_(limits), stop_(stop), finder_(std::make_unique<Finder>(plan, contours, limits)) {
    std::vector<std::uint32_t> edges(plan.edges().size());
    std::iota(edges.begin(), edges.end(), 0U);
    std::vector<std::uint32_t> nodes(plan.nodes().size());
    std::iota(nodes.begin(), nodes.end(), 0U);
    look_at(edges, nodes);
}

FlowFaults::~FlowFaults() = default;

/// @param edges ascending @param nodes likewise
void FlowFaults::look_at(std::span<const std::uint32_t> edges, std::span<const std::uint32_t> nodes) {
    std::vector<KnownFault> walls;
    for (const std::uint32_t e : edges) {
        stop_.check();
        if (plan_.is_edge(e))
            for (const FlowFault& fault : finder_->at_edge(e))
                walls.push_back({e, fault});
    }
    std::vector<KnownFault> corners;
    reach_.resize(plan_.nodes().size());
    for (const std::uint32_t node : nodes) {
        stop_.check();
        if (plan_.degree(node) == 0)
            continue;
        for (const FlowFault& fault : finder_->at_node(node))
            corners.push_back({node, fault});
        reach_[node] = finder_->reach();
    }
    merge_in(walls_, std::move(walls));
    merge_in(corners_, std::move(corners));
}

void FlowFaults::update(std::span<const std::pair<std::uint32_t, std::uint32_t>> changes) {
    const FlowMetric& m = limits_.metric;
    reach_.resize(plan_.nodes().size(), std::max(limits_.gap, limits_.wall));
    std::vector<bool> is_old_node(plan_.nodes().size());
    std::vector<bool> ends_old_edge(plan_.nodes().size());
    // Searches around nodes for changes, because most nodes depend on a small part of the plan nearby.
    EdgeGrid changed;
    for (std::uint32_t i = 0; i < changes.size(); ++i) {
        const auto [from, to] = changes[i];
        changed.add(i, plan_.at(from), plan_.at(to));
        is_old_node[from] = is_old_node[to] = true;
    }
    constexpr double rounding = 2;  // steps
    const double more = rounding * m.longer_step();
    for (std::uint32_t node = 0; node < plan_.nodes().size(); ++node) {
        if (node % 1024 == 0)
            stop_.check();
        if (plan_.degree(node) == 0)
            continue;
        const FinePoint p = plan_.at(node);
        const double less = std::min(limits_.wall, reach_[node]);
        const std::int64_t reach = m.steps_around(std::max(limits_.wall, reach_[node]) + more);
        double nearest = std::numeric_limits<double>::infinity();
        static_cast<void>(changed.all_in_box(
            {p.row - reach, p.col - reach}, {p.row + reach, p.col + reach}, [&](std::uint32_t i) {
                const FinePoint a = plan_.at(changes[i].first);
                const FinePoint b = plan_.at(changes[i].second);
                nearest = std::min(nearest, a == b ? m.distance(p, a) : m.distance_to(p, a, b));
                return nearest > less + more;
            }));
        ends_old_edge[node] = nearest <= limits_.wall + more;
        is_old_node[node] = is_old_node[node] || nearest <= reach_[node] + more;
    }
    std::vector<bool> is_old_edge(plan_.edges().size());
    std::vector<std::uint32_t> edges;
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t e = 0; e < plan_.edges().size(); ++e)
        if (plan_.is_edge(e) &&
            (ends_old_edge[plan_.edges()[e].from] || ends_old_edge[plan_.edges()[e].to])) {
            is_old_edge[e] = true;
            edges.push_back(e);
        }
    for (std::uint32_t node = 0; node < is_old_node.size(); ++node)
        if (is_old_node[node])
            nodes.push_back(node);
    mark_removed(walls_, plan_, is_old_edge);
    erase_if_marked(walls_, is_old_edge);
    erase_if_marked(corners_, is_old_node);
    look_at(edges, nodes);
}

std::vector<FlowFault> find_faults(const PartitionEditor& plan, std::span<const PartitionContour> contours,
                                   const FlowLimits& limits, const StopToken& stop) {
    const FlowFaults known(plan, contours, limits, stop);
    std::vector<FlowFault> faults;
    faults.reserve(known.walls().size() + known.corners().size());
    for (const std::vector<KnownFault>* list : {&known.walls(), &known.corners()})
        for (const KnownFault& fault : *list)
            faults.push_back(fault.fault);
    drop_mirrored(faults, plan);
    return faults;
}

}  // namespace d2b::surface

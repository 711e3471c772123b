#include "flow/flow_mender.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace d2b {

/// What a change at a node may take at most, m2; negative where there may be none.
double FlowMender::most(std::uint32_t node, double most) const {
    for (const NodeArm& arm : plan_.around(node)) {
        if (arm.left != open_ground)
            most = std::min(most, limits_.share * block_area_[static_cast<std::size_t>(arm.left)]);
        for (std::int32_t c = arm.left; c != open_ground && !frozen_.empty();
             c = contours_[static_cast<std::size_t>(c)].parent)
            if (frozen_[static_cast<std::size_t>(c)])
                return -1;
    }
    return most;
}

void FlowMender::touch(std::uint32_t node) {
    touched_.resize(plan_.nodes().size());
    touched_[node] = true;
    for (const NodeArm& arm : plan_.around(node))
        touched_[arm.end] = true;
}

/// The one first that changes least.
bool FlowMender::merge_best(std::vector<Merge> merges) {
    std::ranges::stable_sort(merges, {}, [&](const Merge& m) { return plan_.swept(m.first, m.second); });
    return std::ranges::any_of(merges, [&](const Merge& m) {
        const auto [node, into] = m;
        const double area = static_cast<double>(plan_.swept(node, into)) / 2 * limits_.metric.area();
        if (area > most(node, most(into, std::numeric_limits<double>::infinity())))
            return false;
        touch(node);
        if (!plan_.merge(node, into))
            return false;
        touch(into);
        return true;
    });
}

/// A node of an edge at a place, or near it.
std::optional<std::uint32_t> FlowMender::place_on(std::uint32_t edge, FinePoint place) {
    const PlanEdge e = plan_.edges()[edge];
    const double near = std::max(limits_.wall, limits_.gap) / 2;
    for (const std::uint32_t end : {e.from, e.to})
        if (limits_.metric.distance(plan_.at(end), place) < near)
            return end;
    return plan_.split(edge, place);
}

bool FlowMender::is_fresh(const FlowFault& fault) const {
    const auto is_old = [&](std::uint32_t node) { return node < touched_.size() && touched_[node]; };
    if (is_old(fault.node))
        return false;
    if (fault.kind == FlowKind::gap) {
        const PlanEdge& edge = plan_.edges()[fault.one];
        return plan_.is_edge(fault.one) && !is_old(edge.from) && !is_old(edge.to);
    }
    return !is_old(fault.one) && (fault.kind == FlowKind::wall || !is_old(fault.other));
}

bool FlowMender::mend_gap(const FlowFault& fault) {
    const auto across = place_on(fault.one, fault.place);
    if (!across)
        return false;
    if (merge_best({{fault.node, *across}, {*across, fault.node}}))
        return true;
    touch(*across);
    return false;
}

/// Takes the tip off where both its sides are as far apart as a wall is long.
bool FlowMender::cut_off(const FlowFault& fault) {
    const double half = fault.size / 2 * std::numbers::pi / 180;
    const double chord = 1.01 * std::max(limits_.wall, limits_.gap);
    const double reach = chord / (2 * std::max(std::sin(half), 1e-6));
    const FinePoint tip = plan_.at(fault.node);
    std::vector<std::uint32_t> ends;
    for (const std::uint32_t end : {fault.one, fault.other}) {
        const FinePoint to = plan_.at(end);
        const double share = reach / limits_.metric.distance(tip, to);
        if (share >= 1) {
            ends.push_back(end);
            continue;
        }
        const auto edge = plan_.edge_between(fault.node, end);
        if (!edge)
            return false;
        const FinePoint place{tip.row + std::llround(share * static_cast<double>(to.row - tip.row)),
                              tip.col + std::llround(share * static_cast<double>(to.col - tip.col))};
        const auto node = place_on(*edge, place);
        if (!node || *node == fault.node)
            return false;
        ends.push_back(*node);
    }
    return merge_best({{fault.node, ends[0]}, {fault.node, ends[1]}});
}

bool FlowMender::mend_angle(const FlowFault& fault) {
    const FlowMetric& m = limits_.metric;
    const FinePoint tip = plan_.at(fault.node);
    auto [near, far] = std::pair(fault.one, fault.other);
    if (m.distance(tip, plan_.at(near)) > m.distance(tip, plan_.at(far)))
        std::swap(near, far);
    const FinePoint a = plan_.at(near);
    const FinePoint b = plan_.at(far);
    const double along =
        (m.x(tip, a) * m.x(tip, b) + m.y(tip, a) * m.y(tip, b)) / std::pow(m.distance(tip, b), 2);
    const FinePoint foot{tip.row + std::llround(along * static_cast<double>(b.row - tip.row)),
                         tip.col + std::llround(along * static_cast<double>(b.col - tip.col))};
    const auto edge = plan_.edge_between(fault.node, far);
    if (!edge)
        return false;
    if (m.distance(a, foot) < std::max(limits_.wall, limits_.gap)) {
        const auto node = place_on(*edge, foot);
        if (node && *node != near && *node != fault.node &&
            merge_best({{near, *node}, {*node, near}, {fault.node, near}}))
            return true;
    }
    return cut_off(fault);
}

bool FlowMender::mend(const FlowFault& fault) {
    if (fault.kind == FlowKind::wall)
        return merge_best({{fault.node, fault.one}, {fault.one, fault.node}});
    return fault.kind == FlowKind::gap ? mend_gap(fault) : mend_angle(fault);
}

FlowProblem FlowMender::problem(const FlowFault& fault) const {
    FlowProblem problem;
    problem.kind = fault.kind == FlowKind::wall    ? FlowProblemKind::wall
                   : fault.kind == FlowKind::angle ? FlowProblemKind::angle
                                                   : FlowProblemKind::gap;
    problem.before = problem.after = fault.size;
    problem.place = plan_.at(fault.node);
    const auto add = [&](std::int32_t contour) {
        if (contour != open_ground)
            problem.contours.push_back(contour);
    };
    for (const NodeArm& arm : plan_.around(fault.node))
        add(arm.left);
    if (fault.kind == FlowKind::gap) {
        add(plan_.edges()[fault.one].left);
        add(plan_.edges()[fault.one].right);
    }
    return problem;
}

bool FlowMender::round() {
    touched_.assign(plan_.nodes().size(), false);
    bool any = false;
    for (const FlowFault& fault : find_faults(plan_, contours_, limits_)) {
        if (!is_fresh(fault))
            continue;
        FlowProblem what = problem(fault);
        if (!mend(fault))
            continue;
        any = true;
        what.after = 0;
        what.changed = true;
        changed_.push_back(std::move(what));
    }
    return any;
}

}  // namespace d2b

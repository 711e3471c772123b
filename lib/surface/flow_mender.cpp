#include "surface/flow_mender.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/disjoint_sets.hpp"
#include "outline/fine_geometry.hpp"
#include "surface/nonmanifold_vertices.hpp"

namespace d2b::surface {
namespace {

/// Factor by which new walls exceed the limit, because their corners are rounded to the lattice.
constexpr double slack = 1.02;
/// Distances along a wall at which a corner may be cut off, in lengths of the limit.
constexpr std::array mend_reaches{1.0, 1.4, 2.0, 2.7};
/// Share of a block's remaining budget for moving one long wall, because otherwise the first ones would use
/// it up.
constexpr double merge_share = 0.1;

double area_of(const FineRing& ring, const FlowMetric& metric) {
    double twice = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        const FinePoint a = ring[0];
        twice += static_cast<double>(ring[i].row - a.row) * static_cast<double>(ring[i + 1].col - a.col) -
                 static_cast<double>(ring[i].col - a.col) * static_cast<double>(ring[i + 1].row - a.row);
    }
    return std::abs(twice) / 2 * metric.area();
}

}  // namespace

BlockBudget::BlockBudget(std::span<const PartitionContour> contours, std::span<const PartitionEdge> edges,
                         const FlowLimits& limits)
    : most_(contours.size(), 0), taken_(contours.size(), 0) {
    DisjointSets sets(static_cast<std::uint32_t>(contours.size()));
    for (std::uint32_t c = 0; c < contours.size(); ++c)
        if (contours[c].parent >= 0)
            sets.join(c, static_cast<std::uint32_t>(contours[c].parent));
    for (const PartitionEdge& edge : edges)
        if (edge.left != open_ground && edge.right != open_ground)
            sets.join(static_cast<std::uint32_t>(edge.left), static_cast<std::uint32_t>(edge.right));
    for (std::uint32_t c = 0; c < contours.size(); ++c) {
        block_.push_back(sets.find(c));
        if (contours[c].parent >= 0)
            continue;
        double& most = most_[block_.back()];
        most += limits.share * area_of(contours[c].outline.exterior, limits.metric);
        for (const FineRing& hole : contours[c].outline.interiors)
            most -= limits.share * area_of(hole, limits.metric);
    }
}

std::vector<std::uint32_t> BlockBudget::blocks_of(std::span<const std::int32_t> contours) const {
    std::vector<std::uint32_t> blocks;
    for (const std::int32_t contour : contours)
        if (contour != open_ground)
            blocks.push_back(block_[static_cast<std::size_t>(contour)]);
    std::ranges::sort(blocks);
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
}

bool BlockBudget::allows(std::span<const std::int32_t> contours, double outside, double inside) const {
    return std::ranges::all_of(blocks_of(contours), [&](std::uint32_t block) {
        return taken_[block] + outside <= most_[block] && outside + inside <= most_[block];
    });
}

void BlockBudget::take(std::span<const std::int32_t> contours, double outside) {
    for (const std::uint32_t block : blocks_of(contours))
        taken_[block] += outside;
}

bool FlowMender::is_frozen(std::uint32_t node) const {
    for (const IncidentEdge& arm : plan_.at_node(node))
        for (std::int32_t c = arm.left; c != open_ground; c = contours_[static_cast<std::size_t>(c)].parent)
            if (frozen_[static_cast<std::size_t>(c)])
                return true;
    return false;
}

void FlowMender::touch(std::uint32_t node) {
    touched_.resize(plan_.nodes().size());
    touched_[node] = true;
    for (const IncidentEdge& arm : plan_.at_node(node))
        touched_[arm.end] = true;
}

double FlowMender::square_metres(Int128 twice_steps) const {
    return static_cast<double>(twice_steps) / 2 * limits_.metric.area();
}

FlowMender::Swept FlowMender::swept_by(std::uint32_t node, FinePoint place) const {
    const double outside = square_metres(plan_.swept_outside(node, place));
    return {outside, square_metres(plan_.swept(node, place)) - outside};
}

/// Tries merges in order of the area that they change.
bool FlowMender::merge_best(std::vector<Merge> merges, double share) {
    std::ranges::stable_sort(merges, {},
                             [&](const Merge& m) { return plan_.swept(m.first, plan_.at(m.second)); });
    return std::ranges::any_of(merges, [&](const Merge& m) {
        const auto [node, into] = m;
        const auto [outside, inside] = swept_by(node, plan_.at(into));
        std::vector<std::int32_t> contours;
        for (const std::uint32_t at : {node, into})
            for (const IncidentEdge& arm : plan_.at_node(at))
                contours.push_back(arm.left);
        if (is_frozen(node) || is_frozen(into) || !budget_.allows(contours, outside / share, inside))
            return false;
        touch(node);
        if (!plan_.merge(node, into))
            return false;
        budget_.take(contours, outside);
        touch(into);
        return true;
    });
}

/// Tries a mend and removes its nodes if it fails, because each would be a corner in a straight wall.
template <typename Mend>
bool FlowMender::try_to(const Mend& mend) {
    const std::size_t nodes = plan_.nodes().size();
    if (mend())
        return true;
    plan_.undo_splits(nodes);
    return false;
}

/// Returns a place on the segment from one node to another.
FinePoint FlowMender::along(std::uint32_t from, std::uint32_t to, double metres) const {
    const FinePoint a = plan_.at(from);
    const FinePoint b = plan_.at(to);
    return outline::point_between(a, b, metres / limits_.metric.distance(a, b));
}

/// Returns a node on an edge at or near a place.
std::optional<std::uint32_t> FlowMender::place_on(std::uint32_t edge, FinePoint place) {
    const PartitionEdge e = plan_.edges()[edge];
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
    if (fault.kind == FlowKind::gap || fault.kind == FlowKind::neck) {
        const PartitionEdge& edge = plan_.edges()[fault.one];
        return plan_.is_edge(fault.one) && !is_old(edge.from) && !is_old(edge.to);
    }
    return !is_old(fault.one) && (fault.kind == FlowKind::wall || !is_old(fault.other));
}

/// Returns true if the walls at both ends of a short one run side by side, because the place between them is
/// then as narrow as the short wall.
bool FlowMender::ends_a_narrow_place(std::uint32_t gone, std::uint32_t stays, std::uint32_t next) const {
    constexpr double side_by_side = 0.3;  // cosine
    const FlowMetric& m = limits_.metric;
    const FinePoint a = plan_.at(gone);
    const FinePoint b = plan_.at(stays);
    const FinePoint to = plan_.at(next);
    const auto runs_beside = [&](const IncidentEdge& arm) {
        const FinePoint end = plan_.at(arm.end);
        const double along = dot(m.way(a, to), m.way(b, end));
        return arm.end != gone && along > side_by_side * m.distance(a, to) * m.distance(b, end) &&
               outline::side(a, b, to) * outline::side(a, b, end) >= 0;
    };
    return std::ranges::any_of(plan_.at_node(stays), runs_beside);
}

/// Replaces a short wall by a slanted one that begins a little way along the next wall, because moving a long
/// wall would change far more.
bool FlowMender::slant(std::uint32_t gone, std::uint32_t stays) {
    const std::vector<IncidentEdge> arms = plan_.at_node(gone);
    if (arms.size() != 2)
        return false;
    const std::uint32_t next = arms[arms[0].end == stays ? 1 : 0].end;
    const FlowMetric& m = limits_.metric;
    const double least = slack * std::max(limits_.wall, limits_.gap);
    if (ends_a_narrow_place(gone, stays, next))
        return false;
    for (const double reach : mend_reaches) {
        if (m.distance(plan_.at(gone), plan_.at(next)) < (reach + 1) * least)
            return false;
        const FinePoint place = along(gone, next, reach * least);
        if (m.distance(place, plan_.at(stays)) < least)
            continue;
        const auto edge = plan_.edge_between(gone, next);
        return edge && try_to([&] { return plan_.split(*edge, place) && merge_best({{gone, stays}}); });
    }
    return false;
}

bool FlowMender::mend_wall(const FlowFault& fault) {
    const std::vector<Merge> merges{{fault.node, fault.one}, {fault.one, fault.node}};
    return merge_best(merges, merge_share) || slant(fault.node, fault.one) || slant(fault.one, fault.node) ||
           merge_best(merges);
}

/// Returns true if a place is at least that far from all walls other than those of a node.
bool FlowMender::is_away(FinePoint place, std::uint32_t node, double metres) const {
    const std::int64_t reach = limits_.metric.steps_around(metres);
    return plan_.all_near(
        {place.row - reach, place.col - reach}, {place.row + reach, place.col + reach}, [&](std::uint32_t e) {
            const PartitionEdge& edge = plan_.edges()[e];
            return edge.from == node || edge.to == node ||
                   limits_.metric.distance_to(place, plan_.at(edge.from), plan_.at(edge.to)) >= metres;
        });
}

/// Cuts a corner off that is near a wall, at places on both its walls that are far enough from the other one.
bool FlowMender::cut_corner(const FlowFault& fault) {
    const std::vector<IncidentEdge> arms = plan_.around(fault.node);
    if (arms.size() != 2)
        return false;
    const FlowMetric& m = limits_.metric;
    const double least = slack * std::max(limits_.wall, limits_.gap);
    std::vector<std::pair<std::uint32_t, FinePoint>> places;
    for (const IncidentEdge& arm : arms)
        for (const double reach : mend_reaches) {
            if (m.distance(plan_.at(fault.node), plan_.at(arm.end)) < (reach + 1) * least)
                return false;
            const FinePoint place = along(fault.node, arm.end, reach * least);
            if (!is_away(place, fault.node, least))
                continue;
            places.emplace_back(arm.end, place);
            break;
        }
    if (places.size() != 2 || m.distance(places[0].second, places[1].second) < least)
        return false;
    return try_to([&] {
        std::vector<std::uint32_t> ends;
        for (const auto& [end, place] : places) {
            const auto edge = plan_.edge_between(fault.node, end);
            const auto node = edge ? plan_.split(*edge, place) : std::nullopt;
            if (!node)
                return false;
            ends.push_back(*node);
        }
        return merge_best({{fault.node, ends[0]}, {fault.node, ends[1]}});
    });
}

bool FlowMender::mend_gap(const FlowFault& fault) {
    return cut_corner(fault) || try_to([&] {
               const auto across = place_on(fault.one, fault.place);
               return across && merge_best({{fault.node, *across}, {*across, fault.node}});
           });
}

/// Cuts a tip off at the length at which its sides are one wall apart.
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
        const auto node = place_on(*edge, outline::point_between(tip, to, share));
        if (!node || *node == fault.node)
            return false;
        ends.push_back(*node);
    }
    return merge_best({{fault.node, ends[0]}, {fault.node, ends[1]}});
}

bool FlowMender::mend_angle(const FlowFault& fault) {
    const FlowMetric& m = limits_.metric;
    const FinePoint tip = plan_.at(fault.node);
    auto near = fault.one;
    auto far = fault.other;
    if (m.distance(tip, plan_.at(near)) > m.distance(tip, plan_.at(far)))
        std::swap(near, far);
    const FinePoint a = plan_.at(near);
    const FinePoint b = plan_.at(far);
    const double share = dot(m.way(tip, a), m.way(tip, b)) / std::pow(m.distance(tip, b), 2);
    const FinePoint foot = outline::point_between(tip, b, share);
    const auto edge = plan_.edge_between(fault.node, far);
    if (!edge)
        return false;
    const auto close = [&] {
        const auto node = place_on(*edge, foot);
        return node && *node != near && *node != fault.node &&
               merge_best({{near, *node}, {*node, near}, {fault.node, near}});
    };
    return (m.distance(a, foot) < std::max(limits_.wall, limits_.gap) && try_to(close)) ||
           try_to([&] { return cut_off(fault); });
}

/// Moves a corner to a place away from all other walls.
bool FlowMender::move(std::uint32_t node, FinePoint place) {
    const std::vector<IncidentEdge> arms = plan_.around(node);
    const std::vector<std::int32_t> contours = contours_of(arms);
    // Not a structured binding, because clang 14 cannot capture one.
    const Swept swept = swept_by(node, place);
    if (is_frozen(node) || !budget_.allows(contours, swept.outside, swept.inside) ||
        !is_away(place, node, std::max(limits_.wall, limits_.gap)))
        return false;
    touch(node);
    return std::ranges::any_of(arms, [&](const IncidentEdge& arm) {
        return try_to([&] {
            const auto moved = plan_.split(arm.edge, place);
            if (!moved || !plan_.merge(node, *moved))
                return false;
            budget_.take(contours, swept.outside);
            touch(*moved);
            return true;
        });
    });
}

/// Makes an edge run through a place next to it.
bool FlowMender::bend(std::uint32_t edge, FinePoint place) {
    const PartitionEdge e = plan_.edges()[edge];
    const Int128 turned = outline::turn(plan_.at(e.from), plan_.at(e.to), place);
    const double area = std::abs(square_metres(turned));
    const bool is_outside = e.left == open_ground || e.right == open_ground;
    const std::array contours{e.left, e.right};
    if (is_frozen(e.from) || is_frozen(e.to) ||
        !budget_.allows(contours, is_outside ? area : 0, is_outside ? 0 : area))
        return false;
    const auto node = plan_.split(edge, place);
    if (!node)
        return false;
    if (is_outside)
        budget_.take(contours, area);
    touch(*node);
    return true;
}

/// Widens a narrow part by moving its corner, or the wall across from it, outwards.
bool FlowMender::mend_neck(const FlowFault& fault) {
    const PartitionEdge edge = plan_.edges()[fault.one];
    const FinePoint corner = plan_.at(fault.node);
    const double share = (slack * limits_.wall - fault.size) / fault.size;
    const FinePoint shift{std::llround(share * static_cast<double>(corner.row - fault.place.row)),
                          std::llround(share * static_cast<double>(corner.col - fault.place.col))};
    if (move(fault.node, {corner.row + shift.row, corner.col + shift.col}))
        return true;
    for (const std::uint32_t end : {edge.from, edge.to}) {
        const FinePoint at = plan_.at(end);
        if (limits_.metric.distance(at, fault.place) < limits_.wall)
            return move(end, {at.row - shift.row, at.col - shift.col});
    }
    return bend(fault.one, {fault.place.row - shift.row, fault.place.col - shift.col});
}

bool FlowMender::mend(const FlowFault& fault) {
    switch (fault.kind) {
        case FlowKind::wall:
            return mend_wall(fault);
        case FlowKind::angle:
            return mend_angle(fault);
        case FlowKind::gap:
            return mend_gap(fault);
        case FlowKind::neck:
            return mend_neck(fault);
        case FlowKind::touch:
        case FlowKind::crossing:
            break;  // are no faults of a partition
    }
    return false;
}

FlowProblem problem_of(const FlowFault& fault, const PartitionEditor& plan) {
    FlowProblem problem;
    problem.kind = fault.kind;
    problem.before = problem.after = fault.size;
    problem.place = plan.at(fault.node);
    const auto add = [&](std::int32_t contour) {
        if (contour != open_ground)
            problem.contours.push_back(contour);
    };
    for (const IncidentEdge& arm : plan.at_node(fault.node))
        add(arm.left);
    if (fault.kind == FlowKind::gap || fault.kind == FlowKind::neck) {
        add(plan.edges()[fault.one].left);
        add(plan.edges()[fault.one].right);
    }
    return problem;
}

/// Orders faults: corners, then walls by the area that merging sweeps, then gaps from the narrowest on,
/// because the rest of a gap follows when it is closed at its narrowest, then necks likewise.
std::vector<KnownFault*> FlowMender::in_order() {
    std::vector<std::pair<std::pair<int, double>, KnownFault*>> faults;
    for (std::vector<KnownFault>* list : {&faults_.walls(), &faults_.corners()})
        for (KnownFault& known : *list) {
            const FlowFault& fault = known.fault;
            if (known.tried)
                continue;
            std::pair<int, double> key{0, 0};
            if (fault.kind == FlowKind::wall)
                key = {1, static_cast<double>(std::min(plan_.swept(fault.node, plan_.at(fault.one)),
                                                       plan_.swept(fault.one, plan_.at(fault.node))))};
            if (fault.kind == FlowKind::gap)
                key = {2, fault.size};
            if (fault.kind == FlowKind::neck)
                key = {3, fault.size};
            faults.emplace_back(key, &known);
        }
    std::ranges::stable_sort(faults, {}, [](const auto& fault) { return fault.first; });
    std::vector<KnownFault*> sorted;
    sorted.reserve(faults.size());
    for (const auto& [key, fault] : faults)
        sorted.push_back(fault);
    return sorted;
}

bool FlowMender::round() {
    touched_.assign(plan_.nodes().size(), false);
    bool any = false;
    for (KnownFault* known : in_order()) {
        stop_.check();
        if (!is_fresh(known->fault))
            continue;
        FlowProblem what = problem_of(known->fault, plan_);
        if (!mend(known->fault)) {
            known->tried = true;
            continue;
        }
        any = true;
        what.after = 0;
        what.changed = true;
        changed_.push_back(std::move(what));
    }
    faults_.update(plan_.take_changes());
    return any;
}

}  // namespace d2b::surface

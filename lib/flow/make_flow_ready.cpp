#include "flow/make_flow_ready.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "flow/flow_faults.hpp"
#include "flow/plan_outlines.hpp"
#include "surface/partition.hpp"
#include "surface/plan_editor.hpp"
#include "surface/take_apart_pinches.hpp"

namespace d2b {
namespace {

constexpr int most_rounds = 12;

/// Mends the faults of a plan, round by round.
class FlowMender {
  public:
    /// @param frozen contours that stay as they are; empty for none
    FlowMender(PlanEditor& plan, std::span<const PlanContour> contours, const FlowLimits& limits,
               std::vector<bool> frozen = {})
        : plan_(plan),
          contours_(contours),
          limits_(limits),
          block_area_(block_areas()),
          frozen_(std::move(frozen)) {}

    /// @return whether anything has changed
    [[nodiscard]] bool round();
    [[nodiscard]] std::vector<FlowProblem> take_changed() { return std::move(changed_); }
    [[nodiscard]] FlowProblem problem(const FlowFault& fault) const;

  private:
    using Merge = std::pair<std::uint32_t, std::uint32_t>;  // a node, and what it is merged into
    [[nodiscard]] std::vector<double> block_areas() const;
    [[nodiscard]] double most(std::uint32_t node, double most) const;
    [[nodiscard]] bool is_fresh(const FlowFault& fault) const;
    [[nodiscard]] bool mend(const FlowFault& fault);
    [[nodiscard]] bool mend_angle(const FlowFault& fault);
    [[nodiscard]] bool cut_off(const FlowFault& fault);
    [[nodiscard]] bool mend_gap(const FlowFault& fault);
    [[nodiscard]] bool merge_best(std::vector<Merge> merges);
    [[nodiscard]] std::optional<std::uint32_t> place_on(std::uint32_t edge, FinePoint place);
    void touch(std::uint32_t node);

    PlanEditor& plan_;
    std::span<const PlanContour> contours_;
    const FlowLimits& limits_;
    std::vector<double> block_area_;  // m2, of the block of each contour
    std::vector<bool> frozen_;        // contours
    std::vector<bool> touched_;       // nodes, this round
    std::vector<FlowProblem> changed_;
};

double area_of(const FineRing& ring, const FlowMetric& metric) {
    double twice = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        const FinePoint a = ring[0];
        twice += static_cast<double>(ring[i].row - a.row) * static_cast<double>(ring[i + 1].col - a.col) -
                 static_cast<double>(ring[i].col - a.col) * static_cast<double>(ring[i + 1].row - a.row);
    }
    return std::abs(twice) / 2 * metric.area();
}

/// Touching contours of the lowest level are a block.
std::vector<double> FlowMender::block_areas() const {
    DisjointSets sets(static_cast<std::uint32_t>(contours_.size()));
    for (std::uint32_t c = 0; c < contours_.size(); ++c)
        if (contours_[c].parent >= 0)
            sets.join(c, static_cast<std::uint32_t>(contours_[c].parent));
    for (const PlanEdge& edge : plan_.edges())
        if (edge.left != open_ground && edge.right != open_ground)
            sets.join(static_cast<std::uint32_t>(edge.left), static_cast<std::uint32_t>(edge.right));
    std::vector<double> sums(contours_.size(), 0);
    for (std::uint32_t c = 0; c < contours_.size(); ++c) {
        if (contours_[c].parent >= 0)
            continue;
        double& sum = sums[sets.find(c)];
        sum += area_of(contours_[c].outline.exterior, limits_.metric);
        for (const FineRing& hole : contours_[c].outline.interiors)
            sum -= area_of(hole, limits_.metric);
    }
    std::vector<double> areas;
    for (std::uint32_t c = 0; c < contours_.size(); ++c)
        areas.push_back(sums[sets.find(c)]);
    return areas;
}

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

/// Heights by level: what stands out is what is on a higher one.
std::vector<PlanContour> with_levels(std::span<const PlanContour> contours) {
    std::vector<PlanContour> leveled;
    for (const PlanContour& contour : contours) {
        const std::int64_t below =
            contour.parent < 0 ? 0 : leveled[static_cast<std::size_t>(contour.parent)].top;
        leveled.push_back({{}, contour.parent, contour.building, below + 1});
    }
    return leveled;
}

std::int64_t steps_of(double metres, const FlowMetric& metric) {
    const double step =
        std::min(std::hypot(metric.col_x, metric.col_y), std::hypot(metric.row_x, metric.row_y));
    return static_cast<std::int64_t>(std::ceil(metres / step)) + 1;
}

/// What changing a plan has come to.
struct Changed {
    FlowReady ready;
    std::size_t left = 0;  ///< faults
};

/// Mending makes corners touch, and taking these apart makes short walls.
class Passes {
  public:
    Passes(Plan plan, std::span<const PlanContour> contours, const FlowLimits& limits,
           const std::vector<bool>& frozen)
        : plan_(std::move(plan)), contours_(contours), limits_(limits), frozen_(frozen) {}

    /// @return nothing where outlines would not be what they are to be
    [[nodiscard]] std::optional<Changed> make(std::span<const PlanContour> leveled, const StopRequest& stop);
    /// Contours that were in pieces or gone, where that was the reason.
    [[nodiscard]] const std::vector<std::uint32_t>& broken() const { return broken_; }

  private:
    void mend(const StopRequest& stop);
    [[nodiscard]] bool take_apart(std::span<const PlanContour> leveled);
    [[nodiscard]] bool is_sound(const std::vector<FinePolygon>& outlines) const;

    Plan plan_;
    std::span<const PlanContour> contours_;
    const FlowLimits& limits_;
    const std::vector<bool>& frozen_;
    std::vector<FlowProblem> problems_;
    std::vector<std::uint32_t> broken_;
};

void Passes::mend(const StopRequest& stop) {
    PlanEditor editor(std::move(plan_));
    FlowMender mender(editor, contours_, limits_, frozen_);
    for (int round = 0; round < most_rounds && mender.round(); ++round)
        stop.check();
    std::ranges::move(mender.take_changed(), std::back_inserter(problems_));
    plan_ = editor.plan();
}

/// @return whether all could be
bool Passes::take_apart(std::span<const PlanContour> leveled) {
    const std::int64_t wanted = steps_of(std::max(limits_.wall, limits_.gap), limits_.metric);
    const PinchesTaken taken = take_apart_pinches(plan_, leveled, wanted);
    for (const PinchMend& mend : taken.mends)
        problems_.push_back({FlowProblemKind::touch, 0, limits_.metric.distance(mend.place, mend.moved), true,
                             mend.place, mend.contours});
    return taken.stuck.empty();
}

bool Passes::is_sound(const std::vector<FinePolygon>& outlines) const {
    std::vector<PlanContour> again;
    for (std::size_t c = 0; c < outlines.size(); ++c)
        again.push_back({outlines[c], contours_[c].parent, contours_[c].building, contours_[c].top});
    return make_partition(again).at_odds.empty();
}

std::optional<Changed> Passes::make(std::span<const PlanContour> leveled, const StopRequest& stop) {
    constexpr int passes = 3;
    for (int pass = 0; pass < passes; ++pass) {
        mend(stop);
        if (!take_apart(leveled))
            return std::nullopt;
    }
    PlanOutlines drawn = plan_outlines(plan_, contours_);
    broken_ = std::move(drawn.broken);
    if (!broken_.empty() || !is_sound(drawn.outlines))
        return std::nullopt;
    PlanEditor editor(std::move(plan_));
    const FlowMender measure(editor, contours_, limits_);
    const std::vector<FlowFault> after = find_faults(editor, contours_, limits_);
    for (const FlowFault& fault : after)
        problems_.push_back(measure.problem(fault));
    return Changed{{std::move(drawn.outlines), std::move(problems_)}, after.size()};
}

/// What mending would break stays as it is, and the rest is mended anew. @return nothing where that is no
/// help
std::optional<Changed> change(const Plan& plan, std::span<const PlanContour> contours,
                              const FlowLimits& limits, const StopRequest& stop) {
    constexpr int most_tries = 8;
    const std::vector<PlanContour> leveled = with_levels(contours);
    std::vector<bool> frozen(contours.size());
    for (int i = 0; i < most_tries; ++i) {
        Passes passes(plan, contours, limits, frozen);
        if (auto changed = passes.make(leveled, stop))
            return changed;
        if (passes.broken().empty())
            return std::nullopt;
        for (const std::uint32_t contour : passes.broken())
            frozen[contour] = true;
    }
    return std::nullopt;
}

/// Each once, in a stable order.
void settle(std::vector<FlowProblem>& problems) {
    for (FlowProblem& problem : problems) {
        std::ranges::sort(problem.contours);
        problem.contours.erase(std::unique(problem.contours.begin(), problem.contours.end()),
                               problem.contours.end());
    }
}

}  // namespace

FlowReady make_flow_ready(std::span<const PlanContour> contours, const FlowLimits& limits,
                          const StopRequest& stop) {
    FlowReady result;
    Partition partition = make_partition(contours);
    for (const std::uint32_t c : std::set(partition.at_odds.begin(), partition.at_odds.end()))
        result.problems.push_back({FlowProblemKind::crossing,
                                   0,
                                   0,
                                   false,
                                   contours[c].outline.exterior.front(),
                                   {static_cast<std::int32_t>(c)}});
    if (!result.problems.empty())
        return result;
    const std::vector<PlanContour> leveled = with_levels(contours);
    std::vector<FlowFault> before;
    {
        PlanEditor plan(partition.plan);
        const FlowMender mender(plan, contours, limits);
        before = find_faults(plan, contours, limits);
        for (const FlowFault& fault : before)
            result.problems.push_back(mender.problem(fault));
        Plan touching = partition.plan;
        const PinchesTaken touches = take_apart_pinches(touching, leveled);
        for (const PinchMend& mend : touches.mends)
            result.problems.push_back({FlowProblemKind::touch, 0, 0, false, mend.place, mend.contours});
    }
    if (!result.problems.empty())
        if (auto changed = change(partition.plan, contours, limits, stop);
            changed && changed->left < result.problems.size())
            result = std::move(changed->ready);
    settle(result.problems);
    return result;
}

}  // namespace d2b

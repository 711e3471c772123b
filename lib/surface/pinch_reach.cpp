#include "surface/pinch_reach.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

#include "outline/fine_geometry.hpp"
#include "surface/pinch.hpp"
#include "surface/plan_editor.hpp"

namespace d2b {
namespace {

/// Edges hardly longer than the cut are not split.
constexpr double longest_share = 0.6;

FinePoint towards(FinePoint from, double angle, double steps) {
    return {from.row - std::llround(steps * std::sin(angle)),
            from.col + std::llround(steps * std::cos(angle))};
}

/// Planned cut of a corner.
struct Cut {
    std::vector<NodeArm> arms;
    std::vector<FinePoint> ends;  ///< of the moving arms
    PassedOver area;
};

class ReachPlanner {
  public:
    ReachPlanner(PlanEditor& editor, const PinchReach& wanted) : editor_(editor), wanted_(wanted) {}

    [[nodiscard]] std::optional<Cut> best(std::uint32_t node, const std::vector<NodeArm>& all,
                                          const Pinch& pinch, std::int64_t reach) const;
    void divide(const Cut& cut) const;

  private:
    [[nodiscard]] Cut cut_at(std::uint32_t node, std::vector<NodeArm> arms, std::int64_t reach) const;

    PlanEditor& editor_;
    const PinchReach& wanted_;
};

/// Moves the corner along its bisector and ends its walls at the perpendicular through it.
Cut ReachPlanner::cut_at(std::uint32_t node, std::vector<NodeArm> arms, std::int64_t reach) const {
    const FinePoint from = editor_.at(node);
    const double first = angle_of(from, editor_.at(arms.front().end));
    const double half = turned_from(first, angle_of(from, editor_.at(arms.back().end))) / 2;
    const auto steps = static_cast<double>(reach);
    const FinePoint place = towards(from, first + half, steps);
    const double along = steps * std::clamp(1 / std::max(std::cos(half), 0.1), 1.3, 2.0);
    Cut cut;
    for (const NodeArm& arm : arms) {
        FinePoint end = editor_.at(arm.end);
        const double length =
            std::hypot(static_cast<double>(end.row - from.row), static_cast<double>(end.col - from.col));
        if (along < longest_share * length)
            end = {from.row + std::llround(along / length * static_cast<double>(end.row - from.row)),
                   from.col + std::llround(along / length * static_cast<double>(end.col - from.col))};
        cut.ends.push_back(end);
        cut.area.add(arm, end, from, place);
    }
    cut.arms = std::move(arms);
    return cut;
}

/// Returns the cut that changes the least area, or nothing if none is allowed.
std::optional<Cut> ReachPlanner::best(std::uint32_t node, const std::vector<NodeArm>& all, const Pinch& pinch,
                                      std::int64_t reach) const {
    std::optional<Cut> best;
    for (const SectorRun& run : pinch.runs) {
        Cut cut = cut_at(node, arms_of(all, run), reach);
        const bool allowed =
            !wanted_.allows || wanted_.allows(contours_of(all), cut.area.outside, cut.area.inside);
        if (allowed && (!best || cut.area.outside < best->area.outside))
            best = std::move(cut);
    }
    return best;
}

void ReachPlanner::divide(const Cut& cut) const {
    for (std::size_t i = 0; i < cut.arms.size(); ++i)
        if (cut.ends[i] != editor_.at(cut.arms[i].end))
            static_cast<void>(editor_.split(cut.arms[i].edge, cut.ends[i]));
}

}  // namespace

void PassedOver::add(const NodeArm& beside, FinePoint end, FinePoint from, FinePoint to) {
    const double area = std::abs(static_cast<double>(turn(from, to, end))) / 2;
    (beside.left == open_ground || beside.right == open_ground ? outside : inside) += area;
}

std::vector<std::int32_t> contours_of(const std::vector<NodeArm>& arms) {
    std::vector<std::int32_t> contours;
    for (const NodeArm& arm : arms)
        if (arm.left != open_ground)
            contours.push_back(arm.left);
    std::ranges::sort(contours);
    contours.erase(std::unique(contours.begin(), contours.end()), contours.end());
    return contours;
}

double angle_of(FinePoint from, FinePoint to) {
    return std::atan2(static_cast<double>(from.row - to.row), static_cast<double>(to.col - from.col));
}

double turned_from(double a, double b) {
    const double turn = b - a;
    return turn > 0 ? turn : turn + 2 * std::numbers::pi;
}

std::vector<std::int64_t> reaches_down_from(std::int64_t wanted, const LatticeGap& pinch) {
    std::vector<std::int64_t> reaches;
    for (std::int64_t reach = wanted; reach > std::max(pinch.rows, pinch.cols); reach -= (reach + 3) / 4)
        reaches.push_back(reach);
    return reaches;
}

PlannedReaches plan_reaches(Plan& plan, std::span<const PlanContour> contours, const PinchReach& wanted,
                            const StopRequest& stop) {
    PlannedReaches planned;
    PlanEditor editor(std::move(plan));
    const ReachPlanner planner(editor, wanted);
    const std::vector<std::int64_t> reaches = reaches_down_from(wanted.steps, wanted.gaps.pinch);
    const auto nodes = static_cast<std::uint32_t>(editor.nodes().size());
    for (std::uint32_t node = 0; node < nodes; ++node) {
        const std::vector<NodeArm> arms = editor.around(node);
        const auto pinch = find_pinch(arms, {contours});
        if (!pinch)
            continue;
        stop.check();
        std::int64_t& reach_here = planned[editor.at(node)];
        for (const std::int64_t reach : reaches)
            if (const auto cut = planner.best(node, arms, *pinch, reach)) {
                planner.divide(*cut);
                reach_here = reach;
                break;
            }
    }
    plan = editor.plan();
    return planned;
}

}  // namespace d2b

#include "surface/flow_passes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "surface/flow_faults.hpp"
#include "surface/flow_mender.hpp"
#include "surface/needless_corners.hpp"
#include "surface/partition.hpp"
#include "surface/partition_editor.hpp"
#include "surface/plan_outlines.hpp"
#include "surface/resolve_nonmanifold.hpp"

namespace d2b::surface {
namespace {

constexpr int most_rounds = 12;

std::int64_t steps_of(double metres, const FlowMetric& metric) {
    const double step =
        std::min(std::hypot(metric.col_x, metric.col_y), std::hypot(metric.row_x, metric.row_y));
    return static_cast<std::int64_t>(std::ceil(metres / step)) + 1;
}

CellSize cell_of(const FlowMetric& metric) {
    const double across = std::hypot(metric.col_x, metric.col_y);
    const double down = std::hypot(metric.row_x, metric.row_y);
    return {across * FinePoint::steps, down * FinePoint::steps, metric.area() / (across * down)};
}

}  // namespace

void FlowPasses::mend(const StopToken& stop) {
    PartitionEditor editor(std::move(plan_));
    FlowMender mender(editor, contours_, limits_, budget_, frozen_, stop);
    for (int round = 0; round < most_rounds && mender.round(); ++round)
        continue;
    std::ranges::move(mender.take_changed(), std::back_inserter(problems_));
    plan_ = editor.plan();
}

/// @return true if all could be taken apart
bool FlowPasses::take_apart(std::span<const PartitionContour> leveled, const StopToken& stop) {
    const std::int64_t wanted = steps_of(std::max(limits_.wall, limits_.gap), limits_.metric);
    MoveDistances reach{wanted, gap_tolerances(cell_of(limits_.metric))};
    reach.allows = [&](MoveDistances::Contours contours, double outside, double inside) {
        return budget_.allows(contours, outside * limits_.metric.area(), inside * limits_.metric.area());
    };
    // Takes the least gap even from a block without a budget, because nothing may touch.
    reach.take = [&](MoveDistances::Contours contours, double outside) {
        budget_.take(contours, outside * limits_.metric.area());
    };
    const ResolvedVertices taken = resolve_nonmanifold_vertices(plan_, leveled, reach, stop);
    for (const VertexRepair& mend : taken.repairs)
        problems_.push_back({FlowProblemKind::touch, 0, limits_.metric.distance(mend.place, mend.moved), true,
                             mend.place, mend.contours});
    return taken.unresolved.empty();
}

/// Removes corners that mending and taking apart have put into walls.
void FlowPasses::straighten() {
    PartitionEditor editor(std::move(plan_));
    take_needless_corners(editor, limits_.metric, [&](std::uint32_t node) {
        return std::ranges::none_of(editor.around(node), [&](const IncidentEdge& arm) {
            return arm.left != open_ground && frozen_[static_cast<std::size_t>(arm.left)];
        });
    });
    plan_ = editor.plan();
}

bool FlowPasses::is_sound(const std::vector<FinePolygon>& outlines, const StopToken& stop) const {
    std::vector<PartitionContour> again;
    for (std::size_t c = 0; c < outlines.size(); ++c)
        again.push_back({outlines[c], contours_[c].parent, contours_[c].building, contours_[c].top});
    return make_partition(again, stop).conflicting.empty();
}

/// Repeats a pass that breaks contours without changing these, because all others can be mended.
std::optional<FlowOutlines> FlowPasses::make(std::span<const PartitionContour> leveled,
                                             const StopToken& stop) {
    constexpr int passes = 3;  // of mending and taking apart, before straightening
    constexpr int most_repeats = 7;
    PlanOutlines drawn;
    for (int pass = 0, repeats = 0; pass <= passes;) {
        const PlanarPartition plan = plan_;
        const BlockBudget budget = budget_;
        const std::size_t problems = problems_.size();
        if (pass == passes)
            straighten();
        else if (mend(stop); !take_apart(leveled, stop))
            return std::nullopt;
        drawn = plan_outlines(plan_, contours_, stop);
        if (drawn.broken.empty()) {
            ++pass;
            continue;
        }
        const auto is_frozen = [&](std::uint32_t contour) { return frozen_[contour]; };
        if (repeats++ == most_repeats || std::ranges::all_of(drawn.broken, is_frozen))
            return std::nullopt;
        for (const std::uint32_t contour : drawn.broken)
            frozen_[contour] = true;
        plan_ = plan;
        budget_ = budget;
        problems_.resize(problems);
    }
    if (!is_sound(drawn.outlines, stop))
        return std::nullopt;
    const PartitionEditor editor(std::move(plan_));
    const std::vector<FlowFault> after = find_faults(editor, contours_, limits_, stop);
    for (const FlowFault& fault : after)
        problems_.push_back(problem_of(fault, editor));
    return FlowOutlines{std::move(drawn.outlines), std::move(problems_), after.size()};
}

}  // namespace d2b::surface

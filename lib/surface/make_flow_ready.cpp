#include "surface/make_flow_ready.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include "surface/flow_faults.hpp"
#include "surface/flow_mender.hpp"
#include "surface/flow_passes.hpp"
#include "surface/needless_corners.hpp"
#include "surface/partition.hpp"
#include "surface/partition_editor.hpp"
#include "surface/plan_outlines.hpp"
#include "surface/resolve_nonmanifold.hpp"

namespace d2b::surface {
namespace {

/// Replaces heights by levels, because a contour stands out if it is on a higher level.
std::vector<PartitionContour> with_levels(std::span<const PartitionContour> contours) {
    std::vector<PartitionContour> leveled;
    for (const PartitionContour& contour : contours) {
        const std::int64_t below =
            contour.parent < 0 ? 0 : leveled[static_cast<std::size_t>(contour.parent)].top;
        leveled.push_back({{}, contour.parent, contour.building, below + 1});
    }
    return leveled;
}

/// Returns the outlines without corners in straight walls, or nothing if there are no such corners.
std::vector<FinePolygon> straightened(const PlanarPartition& plan, std::span<const PartitionContour> contours,
                                      const FlowLimits& limits, const std::vector<bool>& frozen,
                                      const StopToken& stop) {
    PartitionEditor editor(plan);
    take_needless_corners(editor, limits.metric, [&](std::uint32_t node) {
        return std::ranges::none_of(editor.around(node), [&](const IncidentEdge& arm) {
            const auto contour = static_cast<std::size_t>(arm.left);
            return arm.left != open_ground && contour < frozen.size() && frozen[contour];
        });
    });
    if (editor.take_changes().empty())
        return {};
    PlanOutlines drawn = plan_outlines(editor.plan(), contours, stop);
    return drawn.broken.empty() ? std::move(drawn.outlines) : std::vector<FinePolygon>();
}

/// Sorts the contours of each problem and removes duplicates.
void settle(std::vector<FlowProblem>& problems) {
    for (FlowProblem& problem : problems) {
        std::ranges::sort(problem.contours);
        problem.contours.erase(std::unique(problem.contours.begin(), problem.contours.end()),
                               problem.contours.end());
    }
}

}  // namespace

FlowReady make_flow_ready(std::span<const PartitionContour> contours, const FlowLimits& limits,
                          const std::vector<bool>& frozen, const StopToken& stop) {
    FlowReady result;
    PartitionResult partition = make_partition(contours, stop);
    for (const std::uint32_t c : std::set(partition.conflicting.begin(), partition.conflicting.end()))
        result.problems.push_back({FlowProblemKind::crossing,
                                   0,
                                   0,
                                   false,
                                   contours[c].outline.exterior.front(),
                                   {static_cast<std::int32_t>(c)}});
    if (!result.problems.empty())
        return result;
    const std::vector<PartitionContour> leveled = with_levels(contours);
    bool touches_itself = false;
    {
        const PartitionEditor plan(partition.plan);
        for (const FlowFault& fault : find_faults(plan, contours, limits, stop))
            result.problems.push_back(problem_of(fault, plan));
        PlanarPartition touching = partition.plan;
        const ResolvedVertices touches = resolve_nonmanifold_vertices(touching, leveled);
        for (const VertexRepair& mend : touches.repairs)
            result.problems.push_back({FlowProblemKind::touch, 0, 0, false, mend.place, mend.contours});
        touches_itself = !touches.repairs.empty();
    }
    if (!result.problems.empty())
        if (auto changed = FlowPasses(partition.plan, contours, limits, frozen).make(leveled, stop);
            changed && (touches_itself || changed->left < result.problems.size()))
            result = {std::move(changed->outlines), std::move(changed->problems)};
    if (result.outlines.empty())
        result.outlines = straightened(partition.plan, contours, limits, frozen, stop);
    settle(result.problems);
    return result;
}

}  // namespace d2b::surface

#include "surface/make_flow_ready.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "surface/faces.hpp"
#include "surface/flow_mender.hpp"
#include "surface/partition.hpp"
#include "surface/partition_editor.hpp"
#include "surface/resolve_nonmanifold.hpp"

namespace d2b::surface {
namespace {

constexpr double straight_m = 0.001;

/// Outlines of a partition.
struct PlanOutlines {
    std::vector<FinePolygon> outlines;  ///< one per contour, if none is broken
    std::vector<std::uint32_t> broken;  ///< contours that are in pieces, or gone
};

/// Draws the outline of each contour from the partition: a contour covers its own faces and those of all
/// contours on top of it. @throws Cancelled
PlanOutlines plan_outlines(const PlanarPartition& plan, std::span<const PartitionContour> contours,
                           const StopToken& stop) {
    // Edges per contour that have it, or a contour on top of it, on one side alone.
    std::vector<std::vector<PartitionEdge>> edges(contours.size());
    const auto parent = [&](std::int32_t contour) {
        return contours[static_cast<std::size_t>(contour)].parent;
    };
    for (const PartitionEdge& edge : plan.edges)
        for (const auto& [from, to, in, out] : {std::tuple(edge.from, edge.to, edge.left, edge.right),
                                                std::tuple(edge.to, edge.from, edge.right, edge.left)})
            for (std::int32_t c = in; c != open_ground && !is_on(out, c, contours); c = parent(c))
                edges[static_cast<std::size_t>(c)].push_back({from, to, c, open_ground});
    PlanOutlines result;
    for (std::uint32_t c = 0; c < edges.size(); ++c) {
        stop.check();
        // With its own nodes, because copying all nodes per contour would take quadratic time.
        const PlanarPartition part = plan_of(std::move(edges[c]), plan.nodes);
        std::vector<OwnedFace> faces = partition_faces(part);
        std::erase_if(faces, [](const OwnedFace& face) { return face.owner == open_ground; });
        if (faces.size() == 1)
            result.outlines.push_back(polygon_of(faces.front().face, part));
        else
            result.broken.push_back(c);
    }
    return result;
}

/// Result of changing a partition.
struct FlowOutlines {
    std::vector<FinePolygon> outlines;  ///< per contour
    std::vector<FlowProblem> problems;
    std::size_t left = 0;  ///< number of faults
};

/// Alternates mending and taking apart, because mending makes corners touch, and taking these apart makes
/// short walls.
class FlowPasses {
  public:
    FlowPasses(PlanarPartition plan, std::span<const PartitionContour> contours, const FlowLimits& limits,
               std::vector<bool> frozen)
        : plan_(std::move(plan)),
          contours_(contours),
          limits_(limits),
          frozen_(std::move(frozen)),
          budget_(contours, plan_.edges, limits) {
        frozen_.resize(contours.size());
    }

    /// @return std::nullopt if a contour would be broken or outlines would cross
    [[nodiscard]] std::optional<FlowOutlines> make(std::span<const PartitionContour> leveled,
                                                   const StopToken& stop);

  private:
    void mend(const StopToken& stop);
    [[nodiscard]] bool take_apart(std::span<const PartitionContour> leveled, const StopToken& stop);
    void straighten();
    [[nodiscard]] bool is_sound(const std::vector<FinePolygon>& outlines, const StopToken& stop) const;

    PlanarPartition plan_;
    std::span<const PartitionContour> contours_;
    const FlowLimits& limits_;
    std::vector<bool> frozen_;  // contours; those that a pass breaks are added
    BlockBudget budget_;        // shared by all passes
    std::vector<FlowProblem> problems_;
};

constexpr int most_rounds = 12;

std::int64_t steps_of(double metres, const FlowMetric& metric) {
    return static_cast<std::int64_t>(std::ceil(metres / metric.shorter_step())) + 1;
}

CellSize cell_of(const FlowMetric& metric) {
    const double across = std::hypot(metric.col.x, metric.col.y);
    const double down = std::hypot(metric.row.x, metric.row.y);
    return {across * FinePoint::steps, down * FinePoint::steps, metric.area() / (across * down)};
}

/// Removes corners within straight walls, except next to contours that are frozen.
void straighten_walls(PartitionEditor& editor, const FlowMetric& metric, const std::vector<bool>& frozen) {
    take_needless_corners(editor, metric, [&](std::uint32_t node) {
        return std::ranges::none_of(editor.around(node), [&](const IncidentEdge& arm) {
            const auto contour = static_cast<std::size_t>(arm.left);
            return arm.left != open_ground && contour < frozen.size() && frozen[contour];
        });
    });
}

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
        problems_.push_back({FlowKind::touch, 0, limits_.metric.distance(mend.place, mend.moved), true,
                             mend.place, mend.contours});
    return taken.unresolved.empty();
}

/// Removes corners that mending and taking apart have put into walls.
void FlowPasses::straighten() {
    PartitionEditor editor(std::move(plan_));
    straighten_walls(editor, limits_.metric, frozen_);
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
    straighten_walls(editor, limits.metric, frozen);
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
        result.problems.push_back({FlowKind::crossing,
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
            result.problems.push_back({FlowKind::touch, 0, 0, false, mend.place, mend.contours});
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

void take_needless_corners(PartitionEditor& plan, const FlowMetric& metric,
                           const std::function<bool(std::uint32_t)>& may_go) {
    const double limit = std::max(straight_m, metric.longer_step());
    std::vector<double> moved(plan.edges().size());  // distance per edge from the corners that it lost, m
    for (std::uint32_t node = 0; node < plan.nodes().size(); ++node) {
        if (plan.degree(node) != 2 || !may_go(node))
            continue;
        const std::vector<IncidentEdge> arms = plan.around(node);
        if (arms[0].end == arms[1].end || plan.edge_between(arms[0].end, arms[1].end))
            continue;
        const double off = metric.distance_to(plan.at(node), plan.at(arms[0].end), plan.at(arms[1].end)) +
                           std::max(moved[arms[0].edge], moved[arms[1].edge]);
        if (off <= limit && plan.merge(node, arms[0].end))
            moved[arms[1].edge] = off;
    }
}

}  // namespace d2b::surface

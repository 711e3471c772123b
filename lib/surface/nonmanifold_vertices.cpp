#include "surface/nonmanifold_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "outline/fine_geometry.hpp"
#include "surface/partition_editor.hpp"
#include "surface/roof_heights.hpp"

namespace d2b::surface {
namespace {

using Arms = std::vector<IncidentEdge>;
using Stands = std::function<bool(std::size_t sector)>;

/// Properties of the sectors around a node that decide if it is manifold. Sector i is on the left of arm i.
struct Sectors {
    std::vector<std::int32_t> contours;
    std::vector<std::int32_t> buildings;
    std::vector<std::int64_t> heights;
};

Sectors sectors_of(FinePoint node, const Arms& arms, std::span<const PartitionContour> contours) {
    Sectors sectors;
    for (const IncidentEdge& arm : arms) {
        sectors.contours.push_back(arm.left);
        sectors.buildings.push_back(
            arm.left == open_ground ? open_ground : contours[static_cast<std::size_t>(arm.left)].building);
    }
    sectors.heights = heights_at(node, sectors.contours, contours);
    return sectors;
}

/// Returns the runs of sectors for which stands(sector) == wanted.
std::vector<SectorRun> runs_of(std::size_t n, const Stands& stands, bool wanted) {
    const auto is = [&](std::size_t i) { return stands(i % n) == wanted; };
    std::vector<SectorRun> runs;
    for (std::size_t i = 0; i < n; ++i) {
        if (!is(i) || is(i + n - 1))
            continue;
        SectorRun run{i, 1};
        while (is(run.first + run.count))
            ++run.count;
        runs.push_back(run);
    }
    return runs;
}

std::vector<std::int32_t> buildings_in(const Sectors& sectors, const SectorRun& run) {
    std::vector<std::int32_t> buildings;
    for (std::size_t i = 0; i < run.count; ++i)
        buildings.push_back(sectors.buildings[(run.first + i) % sectors.buildings.size()]);
    return buildings;
}

bool share_a_building(const Sectors& sectors, const SectorRun& a, const SectorRun& b) {
    const std::vector<std::int32_t> others = buildings_in(sectors, b);
    return std::ranges::any_of(buildings_in(sectors, a), [&](std::int32_t building) {
        return std::ranges::find(others, building) != others.end();
    });
}

/// Gaps and runs alternate, so a gap follows the run with the same index.
std::optional<NonmanifoldVertex> pinch_of(const Sectors& sectors, const Stands& stands) {
    const std::size_t n = sectors.contours.size();
    const std::vector<SectorRun> runs = runs_of(n, stands, true);
    if (runs.size() < 2)
        return std::nullopt;
    NonmanifoldVertex pinch;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const SectorRun& run = runs[i];
        const SectorRun& next = runs[(i + 1) % runs.size()];
        const std::size_t begin = run.first + run.count;
        if (share_a_building(sectors, run, next))
            pinch.runs.push_back({begin % n, (next.first + n - begin) % n});
    }
    pinch.fills = !pinch.runs.empty();
    if (!pinch.fills)
        pinch.runs = runs;
    return pinch;
}

template <typename Number>
std::vector<Number> distinct(std::vector<Number> numbers) {
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}

/// Edges hardly longer than the cut are not split.
constexpr double longest_share = 0.6;

FinePoint towards(FinePoint from, double angle, double steps) {
    return {from.row - std::llround(steps * std::sin(angle)),
            from.col + std::llround(steps * std::cos(angle))};
}

/// Planned cut of a corner.
struct Cut {
    std::vector<IncidentEdge> arms;
    std::vector<FinePoint> ends;  ///< of the moving arms
    SweptArea area;
};

class DistancePlanner {
  public:
    DistancePlanner(PartitionEditor& editor, const MoveDistances& wanted)
        : editor_(editor), wanted_(wanted) {}

    [[nodiscard]] std::optional<Cut> best(std::uint32_t node, const std::vector<IncidentEdge>& all,
                                          const NonmanifoldVertex& pinch, std::int64_t reach) const;
    void divide(const Cut& cut) const;

  private:
    [[nodiscard]] Cut cut_at(std::uint32_t node, std::vector<IncidentEdge> arms, std::int64_t reach) const;

    PartitionEditor& editor_;
    const MoveDistances& wanted_;
};

/// Moves the corner along its bisector and ends its walls at the perpendicular through it.
Cut DistancePlanner::cut_at(std::uint32_t node, std::vector<IncidentEdge> arms, std::int64_t reach) const {
    const FinePoint from = editor_.at(node);
    const double first = angle_of(from, editor_.at(arms.front().end));
    const double half = turned_from(first, angle_of(from, editor_.at(arms.back().end))) / 2;
    const auto steps = static_cast<double>(reach);
    const FinePoint place = towards(from, first + half, steps);
    const double along = steps * std::clamp(1 / std::max(std::cos(half), 0.1), 1.3, 2.0);
    Cut cut;
    for (const IncidentEdge& arm : arms) {
        FinePoint end = editor_.at(arm.end);
        const double length = outline::step_distance(from, end);
        if (along < longest_share * length)
            end = outline::point_between(from, end, along / length);
        cut.ends.push_back(end);
        cut.area.add(arm, end, from, place);
    }
    cut.arms = std::move(arms);
    return cut;
}

/// Returns the cut that changes the least area, or nothing if none is allowed.
std::optional<Cut> DistancePlanner::best(std::uint32_t node, const std::vector<IncidentEdge>& all,
                                         const NonmanifoldVertex& pinch, std::int64_t reach) const {
    std::optional<Cut> best;
    for (const SectorRun& run : pinch.runs) {
        Cut cut = cut_at(node, bounding_half_edges(all, run), reach);
        const bool allowed =
            !wanted_.allows || wanted_.allows(contours_of(all), cut.area.outside, cut.area.inside);
        if (allowed && (!best || cut.area.outside < best->area.outside))
            best = std::move(cut);
    }
    return best;
}

void DistancePlanner::divide(const Cut& cut) const {
    for (std::size_t i = 0; i < cut.arms.size(); ++i)
        if (cut.ends[i] != editor_.at(cut.arms[i].end))
            static_cast<void>(editor_.split(cut.arms[i].edge, cut.ends[i]));
}

}  // namespace

Arms bounding_half_edges(const Arms& all, const SectorRun& run) {
    Arms arms;
    for (std::size_t i = 0; i <= run.count; ++i)
        arms.push_back(all[(run.first + i) % all.size()]);
    return arms;
}

std::optional<NonmanifoldVertex> find_nonmanifold(FinePoint node, const Arms& arms,
                                                  std::span<const PartitionContour> contours) {
    if (arms.size() < 4)
        return std::nullopt;
    const Sectors sectors = sectors_of(node, arms, contours);
    const std::vector<std::int64_t>& heights = sectors.heights;
    std::vector<std::int64_t> levels = heights;
    levels.push_back(no_height);
    for (const std::int64_t level : distinct(std::move(levels))) {
        if (auto pinch = pinch_of(sectors, [&](std::size_t i) { return heights[i] > level; }))
            return pinch;
        for (const std::int32_t building : distinct(sectors.buildings))
            if (building == open_ground)
                continue;
            else if (auto pinch = pinch_of(sectors, [&](std::size_t i) {
                         return sectors.buildings[i] == building && heights[i] > level;
                     }))
                return pinch;
    }
    for (const std::int32_t contour : distinct(sectors.contours))
        if (contour == open_ground)
            continue;
        else if (auto pinch =
                     pinch_of(sectors, [&](std::size_t i) { return sectors.contours[i] == contour; }))
            return pinch;
    return std::nullopt;
}

void SweptArea::add(const IncidentEdge& beside, FinePoint end, FinePoint from, FinePoint to) {
    const double area = std::abs(static_cast<double>(outline::turn(from, to, end))) / 2;
    (beside.left == open_ground || beside.right == open_ground ? outside : inside) += area;
}

std::vector<std::int32_t> contours_of(const std::vector<IncidentEdge>& arms) {
    std::vector<std::int32_t> contours;
    for (const IncidentEdge& arm : arms)
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

std::vector<std::int64_t> distances_down_from(std::int64_t wanted, const LatticeDistance& pinch) {
    std::vector<std::int64_t> reaches;
    for (std::int64_t reach = wanted; reach > std::max(pinch.rows, pinch.cols); reach -= (reach + 3) / 4)
        reaches.push_back(reach);
    return reaches;
}

PlannedDistances plan_distances(PlanarPartition& plan, std::span<const PartitionContour> contours,
                                const MoveDistances& wanted, const StopToken& stop) {
    PlannedDistances planned;
    PartitionEditor editor(std::move(plan));
    const DistancePlanner planner(editor, wanted);
    const std::vector<std::int64_t> reaches = distances_down_from(wanted.steps, wanted.gaps.pinch);
    const auto nodes = static_cast<std::uint32_t>(editor.nodes().size());
    for (std::uint32_t node = 0; node < nodes; ++node) {
        const std::vector<IncidentEdge> arms = editor.around(node);
        const auto pinch = find_nonmanifold(editor.at(node), arms, contours);
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

}  // namespace d2b::surface

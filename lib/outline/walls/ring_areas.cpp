#include "outline/walls/ring_areas.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace d2b::outline {
namespace {

constexpr double max_area_change = 0.02;
constexpr double max_inset_share = 0.4;  // share of an area that walls moving inward may remove
constexpr double max_shift = 0.07;       // cells, mean displacement of the border of a ring
constexpr double min_gain =
    0.1;  // achieved share of a requested change of area below which moving walls is given up

double in_cells(Int128 twice) {
    return static_cast<double>(twice) / (2.0 * FinePoint::steps * FinePoint::steps);
}

}  // namespace

RingAreas::RingAreas(const WallCluster& cluster, const WallGraph& graph, const SegmentGrid::Arcs& arcs,
                     WallLayout& layout, double inset, const StopToken& stop)
    : cluster_(cluster),
      graph_(graph),
      arcs_(arcs),
      layout_(layout),
      inset_(inset),
      stop_(stop),
      areas_(arcs.size()) {
    for (std::size_t c = 0; c < cluster_.contours.size(); ++c) {
        const contours::Contour& contour = cluster_.contours[c];
        const ArcGraph::Outline& outline = graph_.graph.outlines[c];
        first_ring_.push_back(static_cast<std::uint32_t>(rings_.size()));
        rings_.push_back({&outline.exterior, contour.exterior.area(),
                          static_cast<double>(contour.exterior.points()), contour.key.level});
        for (std::size_t i = 0; i < outline.interiors.size(); ++i)
            rings_.push_back({&outline.interiors[i], contour.interiors[i].area(),
                              static_cast<double>(contour.interiors[i].points()), contour.key.level});
    }
    first_ring_.push_back(static_cast<std::uint32_t>(rings_.size()));
    rings_of_ = GroupedIndices(arcs_.size(), [&](const auto& add) {
        for (std::uint32_t r = 0; r < rings_.size(); ++r)
            for (const ArcUse& use : *rings_[r].uses)
                add(use.arc, r);
    });
}

void RingAreas::changed(std::uint32_t arc) {
    const FinePoint origin = fine(cluster_.contours.front().exterior.start());
    Int128 twice = 0;
    for (std::size_t i = 0; i + 1 < arcs_[arc].size(); ++i)
        twice += turn(origin, arcs_[arc][i], arcs_[arc][i + 1]);
    areas_[arc] = twice;
    for (const std::uint32_t ring : rings_of_[arc])
        enqueue(ring);
}

void RingAreas::enqueue(std::uint32_t ring) {
    if (!std::exchange(rings_[ring].pending, true))
        pending_rings_.push_back(ring);
}

Int128 RingAreas::twice_area(const std::vector<ArcUse>& ring) const {
    Int128 sum = 0;
    for (const ArcUse& use : ring)
        sum += use.reversed ? -areas_[use.arc] : areas_[use.arc];
    return sum;
}

void RingAreas::check(const std::vector<bool>& in_conflict) {
    moved_.clear();
    std::vector<std::uint32_t> waiting;
    std::swap(waiting, pending_rings_);
    std::sort(waiting.begin(), waiting.end());
    for (const std::uint32_t r : waiting) {
        stop_.check();
        Ring& ring = rings_[r];
        if (in_conflict[component_of(ring.uses->front().arc)]) {
            pending_rings_.push_back(r);
            continue;
        }
        ring.pending = false;
        const auto before = static_cast<double>(ring.traced);
        const double after = in_cells(twice_area(*ring.uses));
        // Holes grow if walls move inward, because their areas are negative.
        // Narrow rings keep most of their area.
        const double room = inset_ * ring.length;
        const double least = before > 0 ? before - std::min(room, max_inset_share * before) : before - room;
        const double kept = std::clamp(after, least, before);
        if (std::abs(after - kept) > std::max(max_area_change * std::abs(before), max_shift * ring.length)) {
            restore_area(ring, kept - after);
            enqueue(r);
        }
    }
}

/// Restores the area of a ring by moving the walls that belong mostly to it, or else by simplifying its
/// chains of highest rank.
void RingAreas::restore_area(Ring& ring, double missing) {
    // 1 if the ring is on the left of the wall and grows if the wall moves right
    std::vector<std::pair<Wall, double>> right;
    double whole = 0;
    std::set<Wall> found;
    for (const ArcUse& use : *ring.uses) {
        const std::uint32_t c = graph_.chain_of[use.arc];
        // A ring must not move the walls of lower rank on which it stands.
        if (graph_.chains[c].rank < 2 * ring.level)
            continue;
        const ArcUse own = graph_.chains[c].arcs[graph_.index_in_chain[use.arc]];
        for (const Wall wall : layout_.walls_along(use.arc)) {
            if (!found.insert(wall).second)
                continue;
            right.emplace_back(wall, own.reversed == use.reversed ? 1 : -1);
            whole += layout_.length(wall);
        }
    }
    // Rings whose walls a neighbour has moved are measured again first.
    if (std::ranges::any_of(right, [&](const auto& entry) { return moved_.contains(entry.first); }))
        return;
    // The gain of the previous attempt determines the next request.
    const double gain = ring.requested == 0 ? 1 : (ring.missing - missing) / ring.requested;
    if (gain < min_gain || std::abs(missing) >= whole) {
        ring.requested = 0;
        tighten_highest_rank(ring);
        return;
    }
    ring.missing = missing;
    ring.requested = missing / std::clamp(gain, 0.5, 1.25);
    for (const auto& [wall, sign] : right) {
        layout_.shift(wall, -sign * ring.requested / whole);
        moved_.insert(wall);
    }
}

/// Draws the parts of chains of highest rank that belong to the ring with more walls, or else closer to their
/// traces: one small tower must not cost the walls of the whole house on whose border it stands. The walls of
/// lower levels on which it stands stay as they are.
void RingAreas::tighten_highest_rank(const Ring& ring) {
    struct Part {
        std::uint32_t chain;
        std::uint32_t first;  // steps
        std::uint32_t last;
    };
    std::vector<Part> parts;
    int rank = 2 * ring.level;
    for (const ArcUse& use : *ring.uses) {
        const std::uint32_t c = graph_.chain_of[use.arc];
        const std::size_t k = graph_.index_in_chain[use.arc];
        const std::vector<std::uint32_t>& steps = graph_.chains[c].node_steps;
        if (layout_.mode(c).least(steps[k], steps[k + 1]) == FitMode::beveled)
            continue;
        if (graph_.chains[c].rank < 2 * ring.level)
            continue;
        parts.push_back({c, steps[k], steps[k + 1]});
        rank = std::max(rank, graph_.chains[c].rank);
    }
    // A ring that follows its trace can be displaced by the chains on which it ends alone.
    if (parts.empty() && ring.level <= 1)
        for (const ArcUse& use : *ring.uses)
            for (const std::uint32_t node : graph_.ends[use.arc])
                layout_.tighten_at(node, 1);
    std::set<std::uint32_t> replanned;
    for (const Part& part : parts)
        if (graph_.chains[part.chain].rank == rank && !replanned.contains(part.chain)) {
            if (layout_.lower_price(part.chain))
                replanned.insert(part.chain);
            else
                layout_.tighten(part.chain, part.first, part.last, 1);  // with the nodes at its ends
        }
}

}  // namespace d2b::outline

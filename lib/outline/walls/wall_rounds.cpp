#include "outline/walls/wall_rounds.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace d2b {
namespace {

constexpr int patient_rounds = 60;  // rounds before conflicting components fall back to their trace
constexpr double nearby = 1.5;      // cells from a conflict

/// Narrows a range of steps of an edge to those near another edge. @return false if there are none
bool steps_near(const CellShape& shape, const FineSegment& edge, const FineSegment& other, std::size_t& first,
                std::size_t& last) {
    const auto place = [&](FinePoint p) {
        return shape.from_cells(static_cast<double>(p.row - edge.a.row) / FinePoint::steps,
                                static_cast<double>(p.col - edge.a.col) / FinePoint::steps);
    };
    const Vec along = place(edge.b);
    const Vec from = place(other.a);
    const Vec to = place(other.b);
    const std::size_t steps = last - first;
    std::size_t low = last;
    std::size_t high = first;
    for (std::size_t k = 0; k <= steps; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(steps, 1));
        if (square_distance(share * along, from, to) > nearby * nearby)
            continue;
        low = std::min(low, first + k);
        high = std::max(high, first + k);
    }
    if (low > high)
        return false;
    first = low;
    last = high;
    return true;
}

}  // namespace

WallRounds::WallRounds(const WallCluster& cluster, const WallOptions& options, const StopRequest& stop)
    : options_(options),
      stop_(stop),
      graph_(build_wall_graph(cluster, stop)),
      drawing_(graph_, cluster, options, stop),
      arcs_(graph_.graph.arcs.size()),
      steps_(arcs_.size()),
      deviations_(arcs_.size()),
      in_conflict_(graph_.parts),
      areas_(cluster, graph_, arcs_, drawing_, options.inset, stop),
      check_(graph_, arcs_, options.tolerance, stop) {}

void WallRounds::settle() {
    for (round_ = 0;; ++round_) {
        std::vector<std::uint32_t> changed = drawing_.draw();
        if (changed.empty())
            return;
        collect(changed);
        in_conflict_.assign(in_conflict_.size(), false);
        resolve(check_.conflicts(changed));
        check_deviations(changed);
        areas_.check(in_conflict_);
    }
}

/// Copies the drawing. @param changed arcs that may have changed; unchanged ones are removed
void WallRounds::collect(std::vector<std::uint32_t>& changed) {
    std::erase_if(changed, [&](std::uint32_t arc) {
        stop_.check();
        drawing_.arc(arc, drawn_);
        deviations_[arc] = drawn_.deviation;
        steps_[arc].assign(drawn_.steps.begin(), drawn_.steps.end());
        if (drawn_.vertices == arcs_[arc])
            return drawn_.deviation <= options_.tolerance && !check_.notices(arc);
        arcs_[arc].assign(drawn_.vertices.begin(), drawn_.vertices.end());
        areas_.changed(arc);
        return false;
    });
}

/// If an arc is too far from its trace, moves its nodes back if they are displaced; otherwise the arc follows
/// its trace more closely. This may not change the drawing of an arc at all, so arcs that were too far are
/// kept in far_.
void WallRounds::check_deviations(const std::vector<std::uint32_t>& changed) {
    std::vector<std::uint32_t> far;
    std::ranges::set_union(changed, far_, std::back_inserter(far));
    std::erase_if(far, [&](std::uint32_t arc) { return deviations_[arc] <= options_.tolerance; });
    for (const std::uint32_t arc : far) {
        bool any = false;
        for (const std::uint32_t node : graph_.ends[arc])
            if (drawing_.displaced(node) > options_.tolerance / 2)
                any = drawing_.follow_closer_at(node, margin()) || any;
        const auto [first, last] = std::minmax(steps_[arc].front(), steps_[arc].back());
        if (!any && !follow_closer({graph_.chain_of[arc], first, last}))
            follow_nodes(arc);
        in_conflict_[graph_.part_of[graph_.chain_of[arc]]] = true;
    }
    far_ = std::move(far);
}

bool WallRounds::follow_closer(const Place& place) {
    in_conflict_[graph_.part_of[place.chain]] = true;
    return drawing_.follow_closer(place.chain, place.first, place.last, margin());
}

/// Makes the chains at both ends of an arc follow their trace more closely there.
bool WallRounds::follow_nodes(std::uint32_t arc) {
    bool any = false;
    for (const std::uint32_t node : graph_.ends[arc])
        any = drawing_.follow_closer_at(node, margin()) || any;
    return any;
}

/// Steps of an edge near another edge; all of them if none is near.
WallRounds::Place WallRounds::near(Edge e, Edge other) const {
    const auto segment = [&](Edge edge) {
        return FineSegment{arcs_[edge.arc][edge.index], arcs_[edge.arc][edge.index + 1]};
    };
    FineSegment own = segment(e);
    std::size_t first = steps_[e.arc][e.index];
    std::size_t last = steps_[e.arc][e.index + 1];
    if (first > last) {
        std::swap(first, last);
        std::swap(own.a, own.b);
    }
    steps_near(options_.shape, own, segment(other), first, last);
    return {graph_.chain_of[e.arc], first, std::max(last, first + 1)};
}

/// Resolves conflicts among low levels first, because higher levels are drawn on top of them.
void WallRounds::resolve(const WallConflicts& conflicts) {
    const auto is_low = [&](const auto& pair) {
        return std::max(rank(pair.first), rank(pair.second)) <= WallGraph::highest_low_rank;
    };
    const bool low_alone = std::ranges::any_of(conflicts, is_low);
    for (const auto& pair : conflicts)
        if (!low_alone || is_low(pair))
            resolve(pair.first, pair.second);
}

/// Resolves a conflict in favour of the chain drawn first. Of two edges of one rank, the one in the less
/// close mode yields, or both. If neither can, the conflict is due to displaced nodes.
void WallRounds::resolve(Edge a, Edge b) {
    Place near_a = near(a, b);
    Place near_b = near(b, a);
    const auto least = [&](const Place& place) {
        return drawing_.form(place.chain).least(place.first, place.last);
    };
    if (rank(a) < rank(b)) {
        std::swap(a, b);
        std::swap(near_a, near_b);
    }
    bool any = false;
    if (rank(a) > rank(b)) {
        any = follow_closer(near_a) || follow_closer(near_b);
    } else {
        const Form form_a = least(near_a);
        const Form form_b = least(near_b);
        if (form_a <= form_b)
            any = follow_closer(near_a);
        if (form_b <= form_a)
            any = follow_closer(near_b) || any;
    }
    any = any || follow_nodes(a.arc);
    any = any || follow_nodes(b.arc);
    if (!any || round_ >= patient_rounds)
        for (const Place& place : {near_a, near_b})
            trace_part(graph_.part_of[place.chain]);
}

void WallRounds::trace_part(std::uint32_t part) {
    in_conflict_[part] = true;
    for (const std::uint32_t arc : check_.arcs_of_part(part))
        drawing_.trace(graph_.chain_of[arc]);
}

}  // namespace d2b

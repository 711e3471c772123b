#include "outline/walls/wall_rounds.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace d2b {
namespace {

constexpr int patient_rounds = 24;  // in which forms become simpler step by step

}  // namespace

WallRounds::WallRounds(const WallCluster& cluster, const WallOptions& options, const StopRequest& stop)
    : options_(options),
      stop_(stop),
      graph_(build_wall_graph(cluster, stop)),
      drawing_(graph_, cluster, options, stop),
      arcs_(graph_.graph.arcs.size()),
      spans_(arcs_.size()),
      deviations_(arcs_.size()),
      in_conflict_(graph_.parts),
      areas_(cluster, graph_, arcs_, drawing_, stop),
      check_(graph_, drawing_, arcs_, options.tolerance, stop) {}

void WallRounds::settle() {
    for (round_ = 0;; ++round_) {
        std::vector<std::uint32_t> changed = drawing_.draw();
        if (changed.empty())
            return;
        collect(changed);
        in_conflict_.assign(in_conflict_.size(), false);
        for (const auto& [a, b] : check_.conflicts(changed))
            resolve(a, b);
        check_deviations(changed);
        areas_.check(in_conflict_);
    }
}

/// Takes over what is drawn. @param changed arcs that may have changed; those that have not are left out
void WallRounds::collect(std::vector<std::uint32_t>& changed) {
    std::erase_if(changed, [&](std::uint32_t arc) {
        stop_.check();
        drawing_.arc(arc, drawn_);
        deviations_[arc] = drawn_.deviation;
        spans_[arc].assign(drawn_.arcs.begin(), drawn_.arcs.end());
        if (drawn_.vertices == arcs_[arc])
            return drawn_.deviation <= options_.tolerance && !check_.notices(arc);
        arcs_[arc].assign(drawn_.vertices.begin(), drawn_.vertices.end());
        areas_.changed(arc);
        return false;
    });
}

/// A node that has gone so far that an arc on which it stands leaves its trace goes back: the chains that end
/// there take a simpler form, or the arc's own.
void WallRounds::check_deviations(const std::vector<std::uint32_t>& changed) {
    for (const std::uint32_t arc : changed) {
        if (deviations_[arc] <= options_.tolerance)
            continue;
        const std::uint32_t own = graph_.chain_of[arc];
        bool any = false;
        for (const std::uint32_t node : graph_.ends[arc])
            for (std::uint32_t e = graph_.first_end[node]; e < graph_.first_end[node + 1]; ++e) {
                const std::uint32_t other = graph_.chain_of[graph_.arc_ends[e] / 2];
                if (other != own && graph_.chains[other].rank >= graph_.chains[own].rank &&
                    drawing_.form(other) == WallDrawing::Form::fitted) {
                    simplify(other);
                    any = true;
                }
            }
        if (!any)
            simplify(own);
    }
}

void WallRounds::simplify(std::uint32_t chain) {
    while (drawing_.simplify(chain) && round_ >= patient_rounds)
        continue;
    in_conflict_[graph_.part_of[chain]] = true;
}

/// Of two chains in each other's way the one that was drawn later gives way; of two of one rank, both.
void WallRounds::resolve(std::uint32_t a, std::uint32_t b) {
    using Form = WallDrawing::Form;
    const bool a_fixed = drawing_.form(a) == Form::traced;
    const bool b_fixed = drawing_.form(b) == Form::traced;
    const bool settled = drawing_.drawn(a) == Form::traced && drawing_.drawn(b) == Form::traced;
    const int rank_a = graph_.chains[a].rank;
    const int rank_b = graph_.chains[b].rank;
    if (!a_fixed && (b_fixed || rank_a >= rank_b))
        simplify(a);
    if (!b_fixed && a != b && (a_fixed || rank_b >= rank_a))
        simplify(b);
    // Others have brought them into each other's way.
    if (settled)
        for (const std::uint32_t chain : {a, b})
            trace_part(graph_.part_of[chain]);
}

void WallRounds::trace_part(std::uint32_t part) {
    for (const std::uint32_t arc : check_.arcs_of_part(part))
        while (drawing_.simplify(graph_.chain_of[arc]))
            in_conflict_[part] = true;
}

void WallRounds::append(FineRing& to, const ArcUse& use, std::uint32_t number,
                        std::vector<CircularArc>& ring_spans) const {
    const std::vector<FinePoint>& points = arcs_[use.arc];
    const auto begin = static_cast<std::uint32_t>(to.size());
    const auto last = static_cast<std::uint32_t>(points.size() - 1);
    for (const CircularArc& span : spans_[use.arc])
        ring_spans.push_back(
            {number, begin + (use.reversed ? last - span.first - span.edges : span.first), span.edges});
    if (use.reversed)
        to.insert(to.end(), points.rbegin(), points.rend() - 1);
    else
        to.insert(to.end(), points.begin(), points.end() - 1);
}

double WallRounds::arc_length(std::uint32_t arc) const {
    double sum = 0;
    for (std::size_t i = 1; i < arcs_[arc].size(); ++i) {
        const FinePoint a = arcs_[arc][i - 1];
        const FinePoint b = arcs_[arc][i];
        sum += length(options_.shape.from_cells(static_cast<double>(b.row - a.row),
                                                static_cast<double>(b.col - a.col)));
    }
    return sum;
}

WallOutline WallRounds::outline(std::size_t contour) const {
    WallOutline result{{}, {true, 0, 0, 0}};
    double length = 0;
    double length_traced = 0;
    Int128 twice = 0;
    std::int64_t traced = 0;
    const std::span<const RingAreas::Ring> rings = areas_.rings(contour);
    for (std::uint32_t r = 0; r < rings.size(); ++r) {
        FineRing& points = r == 0 ? result.polygon.exterior : result.polygon.interiors.emplace_back();
        for (const ArcUse& use : *rings[r].uses) {
            append(points, use, r, result.polygon.arcs);
            result.quality.deviation = std::max(result.quality.deviation, deviations_[use.arc]);
            const bool fitted = drawing_.form(graph_.chain_of[use.arc]) == WallDrawing::Form::fitted;
            const double arc = arc_length(use.arc);
            length += arc;
            length_traced += fitted ? 0 : arc;
            result.quality.fitted = result.quality.fitted && (fitted || r != 0);
        }
        twice += areas_.twice_area(*rings[r].uses);
        traced += rings[r].traced;
    }
    result.quality.traced_share = length > 0 ? length_traced / length : 0;
    constexpr double unit = 2.0 * FinePoint::steps * FinePoint::steps;
    result.quality.area_change = static_cast<double>(twice) / unit / static_cast<double>(traced) - 1;
    return result;
}

}  // namespace d2b

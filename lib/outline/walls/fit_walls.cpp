#include "outline/walls/fit_walls.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

#include "core/for_rings.hpp"
#include "outline/fine_geometry.hpp"
#include "outline/walls/chain_fitter.hpp"
#include "outline/walls/chain_polyline.hpp"
#include "outline/walls/ring_areas.hpp"
#include "outline/walls/wall_check.hpp"
#include "outline/walls/wall_layout.hpp"

namespace d2b::outline {

/// Assembles an outline from drawn chains, ring by ring, and measures its difference from the trace.
class OutlineBuilder {
  public:
    explicit OutlineBuilder(const WallOptions& options);

    /// Begins a ring; the first one is the exterior. @param traced_area in cells, negative for interior rings
    void begin_ring(std::int64_t traced_area);
    /// Appends a part of a chain that begins at the end of the previous one. @param mode of its chain
    /// @param reversed true if the ring runs against its direction
    void add(const ChainPolyline& stretch, const ChainFitMode& mode, bool reversed);
    [[nodiscard]] WallOutline finish();

  private:
    enum Kind : std::uint8_t { walls, simplified, traced };
    [[nodiscard]] Kind kind(FitMode mode) const;
    [[nodiscard]] FineRing& ring() {
        return rings_ == 1 ? result_.polygon.exterior : result_.polygon.interiors.back();
    }

    CellShape shape_;
    bool can_bevel_;
    WallOutline result_;
    std::uint32_t rings_ = 0;
    std::array<double, 3> lengths_{};  // per kind
    std::int64_t traced_ = 0;
};

/// Draws the walls of a cluster and checks them. Conflicting parts follow their trace more closely until no
/// conflict remains.
class WallFitter {
  public:
    /// @param cluster, stop must outlive this
    WallFitter(const WallCluster& cluster, const WallOptions& options, const StopToken& stop);
    WallFitter(const WallFitter&) = delete;
    WallFitter& operator=(const WallFitter&) = delete;
    ~WallFitter() = default;

    /// Runs rounds until the drawing is valid. Terminates because each round moves a stretch closer to its
    /// trace or uses one of finitely many shifts, and a chain that follows its trace entirely cannot
    /// conflict.
    /// @throws Cancelled
    void resolve_conflicts();
    /// Resulting outline of a contour.
    [[nodiscard]] WallOutline outline(std::size_t contour) const;
    /// Outline of a contour of level 0 or 1, without vertices that only higher levels need.
    [[nodiscard]] WallOutline footprint(std::size_t contour) const;

  private:
    using Edge = SegmentGrid::Edge;
    /// A range of steps of a chain.
    struct StepRange {
        std::uint32_t chain;
        std::size_t first;
        std::size_t last;
    };

    void collect(std::vector<std::uint32_t>& changed);
    void check_deviations(const std::vector<std::uint32_t>& changed);
    void resolve(const WallConflicts& conflicts);
    void resolve(Edge a, Edge b);
    [[nodiscard]] StepRange near(Edge e, Edge other) const;
    bool tighten(const StepRange& place);
    bool tighten_at_nodes(std::uint32_t arc);
    [[nodiscard]] bool is_outdated(std::uint32_t arc) const;
    [[nodiscard]] bool use_trace_around(const StepRange& a, const StepRange& b);
    void revert_to_trace(std::uint32_t component);
    [[nodiscard]] bool needs_low_vertex(const ArcUse& before, const ArcUse& after) const;
    void add_low(const std::vector<ArcUse>& uses, OutlineBuilder& builder) const;
    [[nodiscard]] int rank(Edge e) const { return graph_.chains[graph_.chain_of[e.arc]].rank; }
    [[nodiscard]] std::size_t margin() const { return std::size_t{2} << std::min(round_ / 6, 16); }

    WallOptions options_;
    const StopToken& stop_;
    WallGraph graph_;
    WallLayout layout_;
    SegmentGrid::Arcs arcs_;
    std::vector<std::vector<std::uint32_t>> steps_;  // steps in the chain, per vertex of an arc
    std::vector<double> deviations_;                 // per arc
    std::vector<std::uint32_t> far_;                 // arcs that were too far from their traces, ascending
    std::vector<bool> in_conflict_;                  // components, in this round
    ChainPolyline drawn_;
    RingAreas areas_;
    WallCheck check_;
    int round_ = 0;
};

namespace {

constexpr int max_tightening_rounds = 60;  // rounds before conflicting components fall back to their trace
constexpr double conflict_radius = 1.5;    // cells from a conflict

/// Narrows a range of steps of an edge to those near another edge. @return false if there are none
bool steps_near(const CellShape& shape, const FineSegment& edge, const FineSegment& other, std::size_t& first,
                std::size_t& last) {
    const auto place = [&](FinePoint p) {
        return shape.from_cells(static_cast<double>(p.row - edge.from.row) / FinePoint::steps,
                                static_cast<double>(p.col - edge.from.col) / FinePoint::steps);
    };
    const Vec2 along = place(edge.to);
    const Vec2 from = place(other.from);
    const Vec2 to = place(other.to);
    const std::size_t steps = last - first;
    std::size_t low = last;
    std::size_t high = first;
    for (std::size_t k = 0; k <= steps; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(steps, 1));
        if (square_distance(share * along, from, to) > conflict_radius * conflict_radius)
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

bool has_higher_levels(const WallCluster& cluster) {
    return std::ranges::any_of(cluster.contours,
                               [](const contours::Contour& contour) { return contour.key.level > 1; });
}

}  // namespace

OutlineBuilder::OutlineBuilder(const WallOptions& options)
    : shape_(options.shape),
      can_bevel_(StepMidpoints::can_bevel(options.shape.longer_side(), options.tolerance)) {}

void OutlineBuilder::begin_ring(std::int64_t traced_area) {
    if (rings_++ > 0)
        result_.polygon.interiors.emplace_back();
    traced_ += traced_area;
}

OutlineBuilder::Kind OutlineBuilder::kind(FitMode mode) const {
    if (mode == FitMode::regularized)
        return walls;
    return mode == FitMode::beveled && !can_bevel_ ? traced : simplified;
}

void OutlineBuilder::add(const ChainPolyline& stretch, const ChainFitMode& mode, bool reversed) {
    const std::vector<FinePoint>& points = stretch.vertices;
    FineRing& to = ring();
    const auto begin = static_cast<std::uint32_t>(to.size());
    const auto last = static_cast<std::uint32_t>(points.size() - 1);
    for (const CircularArc& span : stretch.arcs)
        result_.polygon.arcs.push_back(
            {rings_ - 1, begin + (reversed ? last - span.first - span.edges : span.first), span.edges});
    if (reversed)
        to.insert(to.end(), points.rbegin(), points.rend() - 1);
    else
        to.insert(to.end(), points.begin(), points.end() - 1);
    for (std::size_t i = 1; i < points.size(); ++i)
        lengths_[kind(mode.at((stretch.steps[i - 1] + stretch.steps[i]) / 2))] +=
            length(shape_.from_cells(static_cast<double>(points[i].row - points[i - 1].row),
                                     static_cast<double>(points[i].col - points[i - 1].col)));
    result_.quality.deviation_cells = std::max(result_.quality.deviation_cells, stretch.deviation);
}

WallOutline OutlineBuilder::finish() {
    constexpr double little = 0.05;  // share of the length that does not count for the status
    const double whole = lengths_[walls] + lengths_[simplified] + lengths_[traced];
    OutlineQuality& quality = result_.quality;
    quality.simplified = whole > 0 ? lengths_[simplified] / whole : 0;
    quality.kept_traced = whole > 0 ? lengths_[traced] / whole : 0;
    quality.status = quality.kept_traced > little                        ? OutlineStatus::kept_traced
                     : quality.simplified + quality.kept_traced > little ? OutlineStatus::simplified
                                                                         : OutlineStatus::regularized;
    Int128 twice = 0;
    for_rings(result_.polygon, [&](const FineRing& ring) { twice += twice_area(ring); });
    constexpr double unit = 2.0 * FinePoint::steps * FinePoint::steps;
    quality.area_change = static_cast<double>(twice) / unit / static_cast<double>(traced_) - 1;
    return std::move(result_);
}

WallFitter::WallFitter(const WallCluster& cluster, const WallOptions& options, const StopToken& stop)
    : options_(options),
      stop_(stop),
      graph_(build_wall_graph(cluster, stop)),
      layout_(graph_, cluster, options, stop),
      arcs_(graph_.graph.arcs.size()),
      steps_(arcs_.size()),
      deviations_(arcs_.size()),
      in_conflict_(graph_.arcs_of.size()),
      areas_(cluster, graph_, arcs_, layout_, options.inset, stop),
      check_(graph_, arcs_, options.tolerance, stop) {}

void WallFitter::resolve_conflicts() {
    for (round_ = 0;; ++round_) {
        std::vector<std::uint32_t> changed = layout_.draw();
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
void WallFitter::collect(std::vector<std::uint32_t>& changed) {
    std::erase_if(changed, [&](std::uint32_t arc) {
        stop_.check();
        layout_.arc(arc, drawn_);
        deviations_[arc] = drawn_.deviation;
        steps_[arc].assign(drawn_.steps.begin(), drawn_.steps.end());
        if (drawn_.vertices == arcs_[arc])
            return drawn_.deviation <= options_.tolerance && !check_.was_in_conflict(arc);
        arcs_[arc].assign(drawn_.vertices.begin(), drawn_.vertices.end());
        areas_.changed(arc);
        return false;
    });
}

/// If an arc is too far from its trace, moves its nodes back if they are displaced; otherwise the arc follows
/// its trace more closely. This may not change the drawing of an arc at all, so arcs that were too far are
/// kept in far_.
void WallFitter::check_deviations(const std::vector<std::uint32_t>& changed) {
    std::vector<std::uint32_t> far;
    std::ranges::set_union(changed, far_, std::back_inserter(far));
    std::erase_if(far, [&](std::uint32_t arc) { return deviations_[arc] <= options_.tolerance; });
    for (const std::uint32_t arc : far) {
        bool any = false;
        for (const std::uint32_t node : graph_.ends[arc])
            if (layout_.displacement(node) > options_.tolerance / 2)
                any = layout_.tighten_at(node, margin()) || any;
        const auto [first, last] = std::minmax(steps_[arc].front(), steps_[arc].back());
        if (!any && !tighten({graph_.chain_of[arc], first, last}))
            tighten_at_nodes(arc);
        in_conflict_[graph_.component_of[graph_.chain_of[arc]]] = true;
    }
    far_ = std::move(far);
}

bool WallFitter::tighten(const StepRange& place) {
    in_conflict_[graph_.component_of[place.chain]] = true;
    return layout_.tighten(place.chain, place.first, place.last, margin());
}

/// Makes the chains at both ends of an arc follow their trace more closely there.
bool WallFitter::tighten_at_nodes(std::uint32_t arc) {
    bool any = false;
    for (const std::uint32_t node : graph_.ends[arc])
        any = layout_.tighten_at(node, margin()) || any;
    return any;
}

/// Steps of an edge near another edge; all of them if none is near.
WallFitter::StepRange WallFitter::near(Edge e, Edge other) const {
    const auto segment = [&](Edge edge) {
        return FineSegment{arcs_[edge.arc][edge.index], arcs_[edge.arc][edge.index + 1]};
    };
    FineSegment own = segment(e);
    std::size_t first = steps_[e.arc][e.index];
    std::size_t last = steps_[e.arc][e.index + 1];
    if (first > last) {
        std::swap(first, last);
        std::swap(own.from, own.to);
    }
    steps_near(options_.shape, own, segment(other), first, last);
    return {graph_.chain_of[e.arc], first, std::max(last, first + 1)};
}

/// Resolves conflicts among low levels first, because higher levels are drawn on top of them.
void WallFitter::resolve(const WallConflicts& conflicts) {
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
void WallFitter::resolve(Edge a, Edge b) {
    StepRange near_a = near(a, b);
    StepRange near_b = near(b, a);
    const auto least = [&](const StepRange& place) {
        return layout_.mode(place.chain).least(place.first, place.last);
    };
    if (rank(a) < rank(b)) {
        std::swap(a, b);
        std::swap(near_a, near_b);
    }
    if (layout_.lower_price(near_a.chain)) {
        in_conflict_[graph_.component_of[near_a.chain]] = true;
        return;
    }
    bool any = false;
    if (rank(a) > rank(b)) {
        any = tighten(near_a) || tighten(near_b);
    } else {
        const FitMode mode_a = least(near_a);
        const FitMode mode_b = least(near_b);
        if (mode_a <= mode_b)
            any = tighten(near_a);
        if (mode_b <= mode_a)
            any = tighten(near_b) || any;
    }
    any = any || tighten_at_nodes(a.arc);
    any = any || tighten_at_nodes(b.arc);
    any = any || is_outdated(a.arc) || is_outdated(b.arc);
    any = any || use_trace_around(near_a, near_b);
    if (!any || round_ >= max_tightening_rounds)
        for (const StepRange& place : {near_a, near_b})
            revert_to_trace(graph_.component_of[place.chain]);
}

/// Returns true if the chain of an arc, or one on which it ends, has yet to be drawn again, because other
/// conflicts of this round changed its mode: only its new drawing tells whether that suffices.
bool WallFitter::is_outdated(std::uint32_t arc) const {
    return layout_.is_pending(graph_.chain_of[arc]) ||
           std::ranges::any_of(graph_.ends[arc], [&](std::uint32_t node) {
               const std::uint32_t owner = graph_.nodes[node].owner;
               return owner != WallGraph::none && layout_.is_pending(owner);
           });
}

/// Makes two chains follow their trace along more of their length, because walls farther away may be the
/// cause of a conflict. @return false if both follow it everywhere already
bool WallFitter::use_trace_around(const StepRange& a, const StepRange& b) {
    const std::size_t most = std::max(graph_.chains[a.chain].steps(), graph_.chains[b.chain].steps());
    bool any = false;
    for (std::size_t more = std::min(margin(), most); !any && more < 2 * most; more *= 2)
        for (const StepRange& place : {a, b})
            if (layout_.use_trace(place.chain, place.first, place.last, more)) {
                in_conflict_[graph_.component_of[place.chain]] = true;
                any = true;
            }
    return any;
}

void WallFitter::revert_to_trace(std::uint32_t component) {
    in_conflict_[component] = true;
    for (const std::uint32_t arc : graph_.arcs_of[component])
        layout_.use_trace(graph_.chain_of[arc]);
}

WallOutline WallFitter::outline(std::size_t contour) const {
    OutlineBuilder builder(options_);
    ChainPolyline drawn;
    for (const RingAreas::Ring& ring : areas_.rings(contour)) {
        builder.begin_ring(ring.traced);
        for (const ArcUse& use : *ring.uses) {
            layout_.arc(use.arc, drawn);
            builder.add(drawn, layout_.mode(graph_.chain_of[use.arc]), use.reversed);
        }
    }
    return builder.finish();
}

/// Returns true if low levels need a vertex between two uses of a ring, because the chain changes or other
/// low arcs end there.
bool WallFitter::needs_low_vertex(const ArcUse& before, const ArcUse& after) const {
    if (graph_.chain_of[before.arc] != graph_.chain_of[after.arc])
        return true;
    const std::uint32_t node = graph_.ends[after.arc][after.reversed ? 1 : 0];
    const auto is_low = [&](std::uint32_t end) {
        return graph_.ranks[end / 2] <= WallGraph::highest_low_rank;
    };
    return std::ranges::count_if(graph_.ends_at[node], is_low) != 2;
}

void WallFitter::add_low(const std::vector<ArcUse>& uses, OutlineBuilder& builder) const {
    const std::size_t n = uses.size();
    std::size_t begin = 0;
    while (begin < n && !needs_low_vertex(uses[(begin + n - 1) % n], uses[begin]))
        ++begin;
    ChainPolyline drawn;
    for (std::size_t i = begin % n, left = n; left > 0;) {
        std::size_t count = 1;
        while (count < left && !needs_low_vertex(uses[(i + count - 1) % n], uses[(i + count) % n]))
            ++count;
        const bool against = layout_.extract(uses[i], uses[(i + count - 1) % n], begin == n, drawn);
        builder.add(drawn, layout_.mode(graph_.chain_of[uses[i].arc]), against);
        i = (i + count) % n;
        left -= count;
    }
}

WallOutline WallFitter::footprint(std::size_t contour) const {
    OutlineBuilder builder(options_);
    for (const RingAreas::Ring& ring : areas_.rings(contour)) {
        builder.begin_ring(ring.traced);
        add_low(*ring.uses, builder);
    }
    return builder.finish();
}

ClusterOutlines fit_walls(const WallCluster& cluster, const WallOptions& options, const StopToken& stop) {
    ClusterOutlines result;
    WallFitter fitter(cluster, options, stop);
    fitter.resolve_conflicts();
    const bool own_footprints = has_higher_levels(cluster);
    for (std::size_t i = 0; i < cluster.contours.size(); ++i) {
        stop.check();
        result.outlines.push_back(fitter.outline(i));
        if (own_footprints && cluster.contours[i].key.level <= 1)
            result.footprints.push_back(fitter.footprint(i));
    }
    return result;
}

RegularizedOutlines::RegularizedOutlines(const contours::ContourList& contours, const WallOptions& options,
                                         std::unique_ptr<Spool> spool, Executor& executor)
    : contours_(contours),
      spool_(std::move(spool)),
      clusters_(wall_clusters(contours, options, executor.stop())),
      cluster_of_(contours.size()),
      outlines_(contours.size()),
      large_clusters_(std::make_unique<LargeClusters>()) {
    std::size_t low = 0;
    while (low < contours.size() && contours.head(low).key.level <= 1)
        ++low;
    footprints_.resize(low);
    for (std::uint32_t c = 0; c < clusters_.size(); ++c)
        for (const std::uint32_t contour : clusters_[c].numbers)
            cluster_of_[contour] = c;
    // Process the largest clusters first, so that no thread starts one when the others are done.
    std::vector<std::uint32_t> order(clusters_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return clusters_[a].numbers.size() > clusters_[b].numbers.size();
    });
    const auto spooled = [&](const WallOutline& drawn) {
        return spool_outline(drawn.polygon, drawn.quality, *spool_);
    };
    executor.for_each(order.size(), [&](std::size_t i) {
        const ClusterPlan& plan = clusters_[order[i]];
        const WallCluster cluster = fetch_cluster(contours, plan, executor.stop());
        const ClusterOutlines fitted = fit_walls(cluster, options, executor.stop());
        for (std::size_t k = 0; k < plan.numbers.size(); ++k)
            outlines_[plan.numbers[k]] = spooled(fitted.outlines[k]);
        for (std::size_t k = 0; k < fitted.footprints.size(); ++k)
            footprints_[plan.numbers[k]] = spooled(fitted.footprints[k]);
    });
}

std::shared_ptr<const NodedRings> RegularizedOutlines::rings(std::uint32_t cluster) const {
    constexpr std::size_t large = 64;  // contours
    {
        const std::lock_guard lock(large_clusters_->mutex);
        if (const auto known = large_clusters_->rings.find(cluster); known != large_clusters_->rings.end())
            return known->second;
    }
    // Several threads may node the same cluster, because waiting for each other would take longer.
    auto made = std::make_shared<const NodedRings>(fetch_cluster(contours_, clusters_[cluster]).contours);
    if (clusters_[cluster].numbers.size() < large)
        return made;
    const std::lock_guard lock(large_clusters_->mutex);
    return large_clusters_->rings.try_emplace(cluster, made).first->second;
}

FinePolygon RegularizedOutlines::traced(std::size_t contour) const {
    const std::uint32_t cluster = cluster_of_[contour];
    const std::vector<std::uint32_t>& numbers = clusters_[cluster].numbers;
    const auto place = std::ranges::lower_bound(numbers, contour) - numbers.begin();
    return fine(rings(cluster)->polygon(static_cast<std::size_t>(place)));
}

}  // namespace d2b::outline

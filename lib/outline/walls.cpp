#include "outline/walls.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "outline/wall_check.hpp"

namespace d2b {
namespace {

constexpr double largest_area_change = 0.02;
constexpr int most_rounds = 24;  // of drawing and checking, before what is left in conflict is traced

/// Twice the area, positive for exterior rings, in fine squares. Exact.
Int128 twice_area(const FineRing& ring) {
    Int128 sum = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        sum += turn(ring[0], ring[i], ring[i + 1]);
    return sum;
}

double cells(Int128 twice) {
    return static_cast<double>(twice) / (2.0 * FinePoint::steps * FinePoint::steps);
}

}  // namespace

struct RegularOutlines::Impl {
    using Wall = WallDrawing::Wall;

    const std::vector<Contour>& contours;
    WallOptions options;
    WallGraph graph;
    WallDrawing drawing;
    SegmentGrid::Arcs arcs;
    std::vector<std::vector<ArcSpan>> spans;  // of an arc; `ring` is not used
    std::vector<double> deviations;           // of an arc

    Impl(const std::vector<Contour>& the_contours, const WallOptions& the_options)
        : contours(the_contours),
          options(the_options),
          graph(build_wall_graph(the_contours)),
          drawing(graph, the_contours, the_options),
          arcs(graph.graph.arcs.size()),
          spans(arcs.size()),
          deviations(arcs.size()) {}

    void settle();
    void collect(const std::vector<bool>& parts);
    void check_deviations(const std::vector<bool>& parts, std::vector<bool>& changed);
    void resolve(std::uint32_t a, std::uint32_t b, std::vector<bool>& changed);
    void check_areas(const std::vector<bool>& parts, std::vector<bool>& changed);
    void correct(const std::vector<ArcUse>& ring, int level, double missing, std::set<Wall>& moved,
                 std::vector<bool>& changed);
    void simplify(std::uint32_t chain, std::vector<bool>& changed);
    [[nodiscard]] FineRing assemble(const std::vector<ArcUse>& ring, std::uint32_t number,
                                    std::vector<ArcSpan>& ring_spans) const;
    [[nodiscard]] FinePolygon polygon(std::size_t contour) const;
    template <typename Visit>
    void for_each_ring(std::size_t contour, const Visit& visit) const {
        const Contour& c = contours[contour];
        const ArcGraph::Outline& outline = graph.graph.outlines[contour];
        visit(outline.exterior, c.exterior);
        for (std::size_t i = 0; i < outline.interiors.size(); ++i)
            visit(outline.interiors[i], c.interiors[i]);
    }
};

/// Draws, checks, and gives what is in the way a simpler form, until nothing is. Ends: each round makes at
/// least one form simpler or uses up one of the few shifts, and the trace is without fault.
void RegularOutlines::Impl::settle() {
    std::vector<bool> parts(graph.parts, true);
    for (int round = 0; std::ranges::find(parts, true) != parts.end(); ++round) {
        drawing.draw(parts);
        collect(parts);
        std::vector<bool> changed(graph.parts, false);
        for (const auto& [a, b] : WallCheck(graph, arcs, options.tolerance).conflicts(parts))
            resolve(a, b, changed);
        check_deviations(parts, changed);
        check_areas(parts, changed);
        for (std::uint32_t c = 0; c < graph.chains.size(); ++c) {
            while (round >= most_rounds && changed[graph.part_of[c]] && drawing.simplify(c))
                continue;
            if (drawing.stale(c))
                changed[graph.part_of[c]] = true;
        }
        parts = std::move(changed);
    }
}

void RegularOutlines::Impl::collect(const std::vector<bool>& parts) {
    for (std::uint32_t c = 0; c < graph.chains.size(); ++c) {
        if (!parts[graph.part_of[c]])
            continue;
        const Chain& chain = graph.chains[c];
        std::vector<DrawnChain> drawn =
            drawing.course(c).arcs(WallSamples(chain.trace, chain.closed, options.shape));
        for (std::size_t k = 0; k < chain.arcs.size(); ++k) {
            const ArcUse use = chain.arcs[k];
            const auto last = static_cast<std::uint32_t>(drawn[k].vertices.size() - 1);
            if (use.reversed) {
                std::reverse(drawn[k].vertices.begin(), drawn[k].vertices.end());
                for (ArcSpan& span : drawn[k].arcs)
                    span.first = last - span.first - span.edges;
            }
            arcs[use.arc] = std::move(drawn[k].vertices);
            spans[use.arc] = std::move(drawn[k].arcs);
            deviations[use.arc] = drawn[k].deviation;
        }
    }
}

/// A node that has gone so far that an arc on which it stands leaves its trace goes back: the chains that end
/// there take a simpler form, or the arc's own.
void RegularOutlines::Impl::check_deviations(const std::vector<bool>& parts, std::vector<bool>& changed) {
    for (std::uint32_t arc = 0; arc < arcs.size(); ++arc) {
        const std::uint32_t own = graph.chain_of[arc];
        if (!parts[graph.part_of[own]] || deviations[arc] <= options.tolerance)
            continue;
        bool any = false;
        for (const std::uint32_t node : graph.ends[arc])
            for (std::uint32_t e = graph.first_end[node]; e < graph.first_end[node + 1]; ++e) {
                const std::uint32_t other = graph.chain_of[graph.arc_ends[e] / 2];
                if (other != own && graph.chains[other].rank >= graph.chains[own].rank &&
                    drawing.form(other) == WallDrawing::Form::fitted) {
                    simplify(other, changed);
                    any = true;
                }
            }
        if (!any)
            simplify(own, changed);
    }
}

void RegularOutlines::Impl::simplify(std::uint32_t chain, std::vector<bool>& changed) {
    drawing.simplify(chain);
    changed[graph.part_of[chain]] = true;
}

/// Of two chains in each other's way the one that was drawn later gives way; of two of one rank, both.
void RegularOutlines::Impl::resolve(std::uint32_t a, std::uint32_t b, std::vector<bool>& changed) {
    using Form = WallDrawing::Form;
    const bool a_fixed = drawing.form(a) == Form::traced;
    const bool b_fixed = drawing.form(b) == Form::traced;
    const int rank_a = graph.chains[a].rank;
    const int rank_b = graph.chains[b].rank;
    if (!a_fixed && (b_fixed || rank_a >= rank_b))
        simplify(a, changed);
    if (!b_fixed && a != b && (a_fixed || rank_b >= rank_a))
        simplify(b, changed);
}

/// Moves the walls that are a ring's own for the most part, or gives what was drawn last of it a simpler
/// form, where its area is not kept.
void RegularOutlines::Impl::correct(const std::vector<ArcUse>& ring, int level, double missing,
                                    std::set<Wall>& moved, std::vector<bool>& changed) {
    std::map<Wall, double> right;  // 1 where the ring lies on the left of the wall and grows as it goes right
    double whole = 0;
    int rank = -1;
    for (const ArcUse& use : ring) {
        const std::uint32_t c = graph.chain_of[use.arc];
        const auto own = std::ranges::find(graph.chains[c].arcs, use.arc, &ArcUse::arc);
        // What stands on a wall does not move it.
        const bool movable = graph.chains[c].rank >= 2 * level;
        for (const Wall wall :
             !movable ? std::vector<Wall>()
                      : drawing.walls_along(c, static_cast<std::size_t>(own - graph.chains[c].arcs.begin())))
            if (right.emplace(wall, own->reversed == use.reversed ? 1 : -1).second)
                whole += drawing.length(wall);
        if (drawing.form(c) != WallDrawing::Form::traced)
            rank = std::max(rank, graph.chains[c].rank);
    }
    // What a neighbour has moved will be measured again.
    if (std::ranges::any_of(right, [&](const auto& entry) { return moved.contains(entry.first); }))
        return;
    changed[graph.part_of[graph.chain_of[ring.front().arc]]] = true;
    if (std::abs(missing) < whole) {
        for (const auto& [wall, sign] : right) {
            drawing.shift(wall, -sign * missing / whole);
            moved.insert(wall);
        }
        return;
    }
    std::set<std::uint32_t> last;
    for (const ArcUse& use : ring)
        if (graph.chains[graph.chain_of[use.arc]].rank == rank)
            last.insert(graph.chain_of[use.arc]);
    for (const std::uint32_t c : last)
        drawing.simplify(c);
}

void RegularOutlines::Impl::check_areas(const std::vector<bool>& parts, std::vector<bool>& changed) {
    std::vector<ArcSpan> none;
    std::set<Wall> moved;
    const std::vector<bool> in_conflict = changed;
    for (std::size_t i = 0; i < contours.size(); ++i)
        for_each_ring(i, [&](const std::vector<ArcUse>& ring, const PackedRing& traced) {
            const std::uint32_t part = graph.part_of[graph.chain_of[ring.front().arc]];
            if (!parts[part] || in_conflict[part])
                return;
            const auto before = static_cast<double>(traced.area());
            const double after = cells(twice_area(assemble(ring, 0, none)));
            if (std::abs(after - before) > largest_area_change * std::abs(before))
                correct(ring, contours[i].key.level, before - after, moved, changed);
        });
}

FineRing RegularOutlines::Impl::assemble(const std::vector<ArcUse>& ring, std::uint32_t number,
                                         std::vector<ArcSpan>& ring_spans) const {
    FineRing result;
    for (const ArcUse& use : ring) {
        std::vector<FinePoint> points = arcs[use.arc];
        if (use.reversed)
            std::reverse(points.begin(), points.end());
        const auto begin = static_cast<std::uint32_t>(result.size());
        const auto last = static_cast<std::uint32_t>(points.size() - 1);
        for (const ArcSpan& span : spans[use.arc])
            ring_spans.push_back(
                {number, begin + (use.reversed ? last - span.first - span.edges : span.first), span.edges});
        result.insert(result.end(), points.begin(), points.end() - 1);
    }
    return result;
}

FinePolygon RegularOutlines::Impl::polygon(std::size_t contour) const {
    FinePolygon result;
    const ArcGraph::Outline& outline = graph.graph.outlines[contour];
    result.exterior = assemble(outline.exterior, 0, result.arcs);
    for (const auto& ring : outline.interiors)
        result.interiors.push_back(
            assemble(ring, static_cast<std::uint32_t>(result.interiors.size() + 1), result.arcs));
    return result;
}

RegularOutlines::RegularOutlines(const std::vector<Contour>& contours, const WallOptions& options)
    : impl_(std::make_unique<Impl>(contours, options)) {
    impl_->settle();
}

RegularOutlines::RegularOutlines(RegularOutlines&&) noexcept = default;
RegularOutlines& RegularOutlines::operator=(RegularOutlines&&) noexcept = default;
RegularOutlines::~RegularOutlines() = default;

FinePolygon RegularOutlines::polygon(std::size_t contour) const {
    return impl_->polygon(contour);
}

RegularOutlines::Quality RegularOutlines::quality(std::size_t contour) const {
    Quality quality{true, 0, 0};
    std::vector<ArcSpan> none;
    Int128 twice = 0;
    std::int64_t traced = 0;
    impl_->for_each_ring(contour, [&](const std::vector<ArcUse>& ring, const PackedRing& packed) {
        for (const ArcUse& use : ring) {
            const std::uint32_t chain = impl_->graph.chain_of[use.arc];
            if (packed.area() > 0)
                quality.fitted = quality.fitted && impl_->drawing.form(chain) == WallDrawing::Form::fitted;
            quality.deviation = std::max(quality.deviation, impl_->deviations[use.arc]);
        }
        twice += twice_area(impl_->assemble(ring, 0, none));
        traced += packed.area();
    });
    quality.area_change = cells(twice) / static_cast<double>(traced) - 1;
    return quality;
}

}  // namespace d2b

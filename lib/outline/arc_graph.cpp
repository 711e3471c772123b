#include "outline/arc_graph.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "core/for_rings.hpp"

namespace d2b::outline {

namespace {

constexpr std::uint32_t sign_bit = 0x80000000U;

/// Key that sorts like the pair (first, second).
std::uint64_t sort_key(std::int32_t first, std::int32_t second) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(first) ^ sign_bit) << 32 |
           (static_cast<std::uint32_t>(second) ^ sign_bit);
}

class ArcCutter {
  public:
    using Vertex = NodedRings::Vertex;

    ArcCutter(const NodedRings& net, std::vector<Arc>& arcs)
        : net_(net), arcs_(arcs), known_(4 * net.size(), nowhere) {}

    std::vector<ArcUse> cut(std::span<const Vertex> ring) {
        const auto junction =
            std::find_if(ring.begin(), ring.end(), [&](Vertex v) { return net_.junction(v); });
        const auto start = static_cast<std::size_t>(
            (junction != ring.end() ? junction : std::min_element(ring.begin(), ring.end())) - ring.begin());
        std::vector<ArcUse> uses;
        arc_.assign(1, ring[start]);
        for (std::size_t i = 1; i <= ring.size(); ++i) {
            const std::size_t at = start + i;
            arc_.push_back(ring[at < ring.size() ? at : at - ring.size()]);
            if (i == ring.size() || net_.junction(arc_.back())) {
                uses.push_back(use());
                arc_.assign(1, arc_.back());
            }
        }
        return uses;
    }

  private:
    static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

    /// Returns the current arc. Arcs are identified by their first edge in the direction with the smaller
    /// one.
    ArcUse use() {
        const std::pair forwards(arc_.front(), arc_[1]);
        const std::pair backwards(arc_.back(), arc_[arc_.size() - 2]);
        const bool reversed = backwards < forwards;
        const auto [from, to] = reversed ? backwards : forwards;
        std::uint32_t& known =
            known_[4 * std::size_t{from} + static_cast<std::size_t>(net_.direction(from, to))];
        if (known == nowhere) {
            known = static_cast<std::uint32_t>(arcs_.size());
            Arc& arc = arcs_.emplace_back();
            arc.reserve(arc_.size());
            for (const Vertex v : arc_)
                arc.push_back(net_.point(v));
            if (reversed)
                std::reverse(arc.begin(), arc.end());
        }
        return {known, reversed};
    }

    const NodedRings& net_;
    std::vector<Arc>& arcs_;
    std::vector<std::uint32_t> known_;  // arc per vertex and direction
    std::vector<Vertex> arc_;
};

LatticeRing assemble(const std::vector<ArcUse>& uses, const std::vector<Arc>& arcs) {
    LatticeRing ring;
    for (const ArcUse& use : uses) {
        const Arc& arc = arcs[use.arc];
        // Omit the last point of each arc, because it is the first of the next arc.
        if (use.reversed)
            ring.insert(ring.end(), arc.rbegin(), arc.rend() - 1);
        else
            ring.insert(ring.end(), arc.begin(), arc.end() - 1);
    }
    return ring;
}

}  // namespace

NodedRings::NodedRings(const std::vector<contours::Contour>& contours, const StopToken& stop)
    : first_ring_{0} {
    std::vector<LatticePoint> corners;
    std::vector<std::size_t> ends;
    std::size_t count = 0;
    for (const contours::Contour& contour : contours) {
        first_ring_.push_back(first_ring_.back() + 1 + contour.interiors.size());
        for_rings(contour, [&](const PackedRing& ring) { count += ring.corner_count(); });
    }
    corners.reserve(count);
    const auto add = [&](const PackedRing& packed) {
        stop.check();
        const LatticeRing ring = packed.corners();
        corners.insert(corners.end(), ring.begin(), ring.end());
        ends.push_back(corners.size());
    };
    for (const contours::Contour& contour : contours)
        for_rings(contour, add);
    stop.check();
    const std::vector<Vertex> numbers = number_corners(corners, stop);
    stop.check();
    const Columns by_col = columns();
    directions_.assign(points_.size(), 0);
    vertices_.reserve(numbers.size() + numbers.size() / 4);
    first_.reserve(ends.size() + 1);
    first_.push_back(0);
    std::size_t begin = 0;
    for (const std::size_t end : ends) {
        stop.check();
        for (std::size_t i = begin; i < end; ++i)
            append_edge(numbers[i], numbers[i + 1 < end ? i + 1 : begin], by_col);
        first_.push_back(vertices_.size());
        begin = end;
    }
}

LatticePolygon NodedRings::polygon(std::size_t contour) const {
    const auto points = [&](std::size_t r) {
        LatticeRing result;
        for (const Vertex v : ring(r))
            result.push_back(points_[v]);
        return result;
    };
    LatticePolygon result{points(first_ring(contour)), {}};
    for (std::size_t r = first_ring(contour) + 1; r < first_ring(contour + 1); ++r)
        result.interiors.push_back(points(r));
    return result;
}

/// @return vertex per corner
std::vector<NodedRings::Vertex> NodedRings::number_corners(const std::vector<LatticePoint>& corners,
                                                           const StopToken& stop) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order(corners.size());
    for (std::uint32_t i = 0; i < corners.size(); ++i)
        order[i] = {sort_key(corners[i].row, corners[i].col), i};
    stop.check();
    std::sort(order.begin(), order.end());
    stop.check();
    std::vector<Vertex> numbers(corners.size());
    points_.reserve(corners.size());
    for (const auto& [place, corner] : order) {
        if (points_.empty() || points_.back() != corners[corner])
            points_.push_back(corners[corner]);
        numbers[corner] = static_cast<Vertex>(points_.size() - 1);
    }
    return numbers;
}

NodedRings::Columns NodedRings::columns() const {
    std::vector<std::pair<std::uint64_t, Vertex>> order(points_.size());
    for (Vertex v = 0; v < points_.size(); ++v)
        order[v] = {sort_key(points_[v].col, points_[v].row), v};
    std::sort(order.begin(), order.end());
    Columns columns{std::vector<Vertex>(order.size()), std::vector<Vertex>(order.size())};
    for (Vertex place = 0; place < order.size(); ++place) {
        columns.vertices[place] = order[place].second;
        columns.places[order[place].second] = place;
    }
    return columns;
}

NodedRings::Direction NodedRings::direction(Vertex from, Vertex to) const {
    if (points_[from].row == points_[to].row)
        return from < to ? Direction::east : Direction::west;
    return from < to ? Direction::south : Direction::north;
}

/// Appends all vertices from one corner to the next, exclusive.
void NodedRings::append_edge(Vertex from, Vertex to, const Columns& columns) {
    const Direction forwards = direction(from, to);
    const bool along_row = points_[from].row == points_[to].row;
    const auto ahead = static_cast<std::uint8_t>(1U << static_cast<unsigned>(forwards));
    const auto behind = static_cast<std::uint8_t>(1U << (static_cast<unsigned>(forwards) ^ 2U));
    const auto next = [&](Vertex v) {
        if (along_row)
            return from < to ? v + 1 : v - 1;
        return columns.vertices[from < to ? columns.places[v] + 1 : columns.places[v] - 1];
    };
    for (Vertex v = from; v != to;) {
        vertices_.push_back(v);
        directions_[v] |= ahead;
        v = next(v);
        directions_[v] |= behind;
    }
}

ArcGraph build_arc_graph(const NodedRings& rings, const StopToken& stop) {
    ArcGraph graph;
    ArcCutter cutter(rings, graph.arcs);
    graph.outlines.reserve(rings.contours());
    for (std::size_t contour = 0; contour < rings.contours(); ++contour) {
        ArcGraph::Outline& outline = graph.outlines.emplace_back();
        const std::size_t exterior = rings.first_ring(contour);
        outline.exterior = cutter.cut(rings.ring(exterior));
        outline.interiors.reserve(rings.first_ring(contour + 1) - exterior - 1);
        for (std::size_t r = exterior + 1; r < rings.first_ring(contour + 1); ++r) {
            stop.check();
            outline.interiors.push_back(cutter.cut(rings.ring(r)));
        }
        stop.check();
    }
    return graph;
}

LatticePolygon ArcGraph::polygon(std::size_t contour) const {
    const Outline& outline = outlines[contour];
    LatticePolygon result{assemble(outline.exterior, arcs), {}};
    for (const auto& ring : outline.interiors)
        result.interiors.push_back(assemble(ring, arcs));
    return result;
}

}  // namespace d2b::outline

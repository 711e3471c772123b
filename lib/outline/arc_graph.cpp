#include "outline/arc_graph.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "outline/lattice_net.hpp"

namespace d2b {
namespace {

class ArcCutter {
  public:
    using Vertex = LatticeNet::Vertex;

    ArcCutter(const LatticeNet& net, std::vector<Arc>& arcs)
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
        std::uint32_t& known = known_[4 * std::size_t{from} + static_cast<std::size_t>(net_.way(from, to))];
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

    const LatticeNet& net_;
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

ArcGraph build_arc_graph(std::span<const Contour* const> contours, const StopRequest& stop) {
    const LatticeNet net(contours, stop);
    ArcGraph graph;
    ArcCutter cutter(net, graph.arcs);
    graph.outlines.reserve(contours.size());
    std::size_t ring = 0;
    for (const Contour* contour : contours) {
        stop.check();
        ArcGraph::Outline& outline = graph.outlines.emplace_back();
        outline.exterior = cutter.cut(net.ring(ring++));
        outline.interiors.reserve(contour->interiors.size());
        for (std::size_t i = 0; i < contour->interiors.size(); ++i) {
            stop.check();
            outline.interiors.push_back(cutter.cut(net.ring(ring++)));
        }
    }
    return graph;
}

ArcGraph build_arc_graph(const std::vector<Contour>& contours, const StopRequest& stop) {
    std::vector<const Contour*> all;
    all.reserve(contours.size());
    for (const Contour& contour : contours)
        all.push_back(&contour);
    return build_arc_graph(all, stop);
}

LatticePolygon ArcGraph::polygon(std::size_t contour) const {
    const Outline& outline = outlines[contour];
    LatticePolygon result{assemble(outline.exterior, arcs), {}};
    for (const auto& ring : outline.interiors)
        result.interiors.push_back(assemble(ring, arcs));
    return result;
}

}  // namespace d2b

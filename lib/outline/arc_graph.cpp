#include "outline/arc_graph.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace d2b {
namespace {

/// Points where a number of edges other than two meet, sorted.
std::vector<LatticePoint> find_junctions(const std::vector<LatticePolygon>& polygons) {
    std::vector<std::pair<LatticePoint, LatticePoint>> ends;  // each edge from both of its points, once
    const auto add = [&](const LatticeRing& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const LatticePoint next = ring[(i + 1) % ring.size()];
            ends.emplace_back(ring[i], next);
            ends.emplace_back(next, ring[i]);
        }
    };
    for (const LatticePolygon& polygon : polygons) {
        add(polygon.exterior);
        for (const LatticeRing& ring : polygon.interiors)
            add(ring);
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    std::vector<LatticePoint> junctions;
    for (std::size_t i = 0; i < ends.size();) {
        std::size_t next = i;
        while (next < ends.size() && ends[next].first == ends[i].first)
            ++next;
        if (next - i != 2)
            junctions.push_back(ends[i].first);
        i = next;
    }
    return junctions;
}

class ArcCutter {
  public:
    ArcCutter(const std::vector<LatticePoint>& junctions, std::vector<Arc>& arcs)
        : junctions_(junctions), arcs_(arcs) {}

    std::vector<ArcUse> cut(const LatticeRing& ring) {
        std::size_t start =
            static_cast<std::size_t>(std::min_element(ring.begin(), ring.end()) - ring.begin());
        for (std::size_t i = 0; i < ring.size(); ++i)
            if (is_junction(ring[i]) && !is_junction(ring[start]))
                start = i;
        std::vector<ArcUse> uses;
        Arc arc{ring[start]};
        for (std::size_t i = 1; i <= ring.size(); ++i) {
            arc.push_back(ring[(start + i) % ring.size()]);
            if (i == ring.size() || is_junction(arc.back())) {
                const LatticePoint last = arc.back();
                uses.push_back(use(std::move(arc)));
                arc = {last};
            }
        }
        return uses;
    }

  private:
    [[nodiscard]] bool is_junction(LatticePoint point) const {
        return std::binary_search(junctions_.begin(), junctions_.end(), point);
    }

    /// An arc is known by its first edge, in the direction in which that is the smaller one.
    ArcUse use(Arc&& arc) {
        const std::array<LatticePoint, 2> forwards{arc.front(), arc[1]};
        const std::array<LatticePoint, 2> backwards{arc.back(), arc[arc.size() - 2]};
        const bool reversed = backwards < forwards;
        const auto [known, is_new] = known_.try_emplace(std::min(forwards, backwards), arcs_.size());
        if (is_new) {
            if (reversed)
                std::reverse(arc.begin(), arc.end());
            arcs_.push_back(std::move(arc));
        }
        return {static_cast<std::uint32_t>(known->second), reversed};
    }

    const std::vector<LatticePoint>& junctions_;
    std::vector<Arc>& arcs_;
    std::map<std::array<LatticePoint, 2>, std::size_t> known_;
};

LatticeRing assemble(const std::vector<ArcUse>& uses, const std::vector<Arc>& arcs) {
    LatticeRing ring;
    for (const ArcUse& use : uses) {
        const Arc& arc = arcs[use.arc];
        // Each arc but for its last point, which is the first of the next one.
        if (use.reversed)
            ring.insert(ring.end(), arc.rbegin(), arc.rend() - 1);
        else
            ring.insert(ring.end(), arc.begin(), arc.end() - 1);
    }
    return ring;
}

}  // namespace

ArcGraph build_arc_graph(const std::vector<Contour>& contours) {
    const CornerIndex corners(contours);
    std::vector<LatticePolygon> polygons;
    polygons.reserve(contours.size());
    for (const Contour& contour : contours)
        polygons.push_back(corners.noded(traced_polygon(contour)));
    const std::vector<LatticePoint> junctions = find_junctions(polygons);
    ArcGraph graph;
    ArcCutter cutter(junctions, graph.arcs);
    for (const LatticePolygon& polygon : polygons) {
        ArcGraph::Outline& outline = graph.outlines.emplace_back();
        outline.exterior = cutter.cut(polygon.exterior);
        for (const LatticeRing& ring : polygon.interiors)
            outline.interiors.push_back(cutter.cut(ring));
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

}  // namespace d2b

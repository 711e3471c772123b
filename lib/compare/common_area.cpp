#include "compare/common_area.hpp"

#include <algorithm>
#include <cstddef>

#include "geometry/box_tree.hpp"
#include "score/measure.hpp"

namespace d2b::compare {
namespace {

/// Boxes of all edges of a region.
std::vector<Box> edge_boxes(const Polygons& region) {
    std::vector<Box> boxes;
    const auto add = [&](const WorldRing& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            Box box;
            box.add(ring[i]);
            box.add(ring[(i + 1) % ring.size()]);
            boxes.push_back(box);
        }
    };
    for (const WorldPolygon& polygon : region) {
        add(polygon.exterior);
        std::ranges::for_each(polygon.interiors, add);
    }
    return boxes;
}

}  // namespace

std::vector<double> shares_in_region(std::span<const Polygons> outlines, const Polygons& region,
                                     Overlay& overlay) {
    const BoxTree edges(edge_boxes(region));
    // Most outlines do not meet the border, so that one of their points decides.
    std::vector<WorldPolygon> first_parts;
    for (const Polygons& outline : outlines)
        first_parts.push_back(outline.front());
    const auto containing = overlay.containing_polygons(first_parts, region);
    std::vector<double> shares;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        if (edges.intersects_any(box_of(outlines[i])))
            shares.push_back(score::share(score::area_of(overlay.intersection(outlines[i], region)),
                                          score::area_of(outlines[i])));
        else
            shares.push_back(containing[i] ? 1 : 0);
    }
    return shares;
}

}  // namespace d2b::compare

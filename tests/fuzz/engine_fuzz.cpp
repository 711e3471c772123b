// Any small grid is traced as the slow reference traces it, in bands of any height.
#include <algorithm>

#include "contours/reference.hpp"
#include "fuzz/bytes.hpp"
#include "geometry/geos.hpp"
#include "outline/arc_graph.hpp"
#include "outline/outline.hpp"
#include "support/outline_checks.hpp"

namespace d2b::test {
namespace {

void compare(const ContourSet& set, const std::vector<ReferenceContour>& expected) {
    demand(set.contours.size() == expected.size(), "there are as many contours as in the reference");
    Geos geos;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const contours::Contour& contour = set.contours[i];
        const ReferenceContour& wanted = expected[i];
        demand(contour.key == contours::ContourKey{wanted.level, *wanted.squares.begin()},
               "contours have their keys");
        demand(squares_inside(contour) == wanted.squares, "a contour holds the squares of its region");
        demand(contour.squares() == static_cast<std::int64_t>(wanted.squares.size()), "squares are counted");
        demand(contour.exterior.points() == wanted.exterior_points, "points of the exterior are counted");
        demand(contour.interiors.size() == wanted.interiors, "holes are rings");
        const FinePolygon polygon = fine(contours::traced_polygon(contour));
        demand(geos.invalidity({unit_grid.polygon(polygon)}).empty(), "polygons are valid");
        demand(planar_area(polygon) == static_cast<double>(contour.squares()), "areas are as counted");
        if (wanted.level == 0)
            demand(contour.parent == -1, "roots have no parent");
        else
            demand(set.contours[static_cast<std::size_t>(contour.parent)].key ==
                       contours::ContourKey{wanted.level - 1, wanted.parent_first},
                   "contours stand on what is below them");
    }
}

}  // namespace
}  // namespace d2b::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace d2b::test;
    Bytes bytes(data, size);
    TraceSettings settings;
    settings.rows_a_band = static_cast<std::int32_t>(1 + bytes.below(8));
    settings.linked_alone = bytes.below(2) == 0;
    const RandomGridCase c = grid_of(bytes, 12);
    settings.mode = c.mode;
    d2b::Context context;
    compare(trace_grid(c.grid, c.thresholds, settings, context),
            reference_contours(c.grid, c.thresholds, c.mode));
    return 0;
}

// Outlines of any small grid stay valid, nested and disjoint where they are simplified or get straight walls.
#include <algorithm>
#include <array>
#include <cmath>

#include "fuzz/bytes.hpp"
#include "geometry/geos.hpp"
#include "outline/outline.hpp"
#include "outline/outline_checks.hpp"

namespace d2b::test {
namespace {

OutlineOptions options_of(Bytes& bytes, bool walls) {
    OutlineOptions options;
    const unsigned size = bytes.next();
    if (walls) {
        options.walls = std::array{Walls::automatic, Walls::free, Walls::right}[bytes.below(3)];
        options.wall_tolerance = 0.5 + size % 4 * 0.5;
    } else {
        options.simplify = 0.5 + size % 8 * 0.5;
    }
    return options;
}

void check(const ContourSet& set, const Outliner& outliner) {
    Geos geos;
    std::vector<std::vector<FinePolygon>> children(set.contours.size());
    std::vector<double> covered(set.contours.size(), 0);
    for (std::size_t i = 0; i < set.contours.size(); ++i) {
        const FinePolygon polygon = outliner.outline(i);
        demand(geos.invalidity({unit_grid.polygon(polygon)}).empty(), "polygons are valid");
        if (set.contours[i].key.level <= 1)
            demand(geos.invalidity({unit_grid.polygon(outliner.footprint(i))}).empty(),
                   "footprints are valid");
        demand(polygon.interiors.size() == set.contours[i].interiors.size(), "no hole is lost");
        if (set.contours[i].parent < 0)
            continue;
        const auto parent = static_cast<std::size_t>(set.contours[i].parent);
        children[parent].push_back(polygon);
        covered[parent] += planar_area(polygon);
    }
    for (std::size_t i = 0; i < set.contours.size(); ++i) {
        double left = 0;
        const FinePolygon parent = outliner.outline(i);
        for (const FinePolygon& piece : geos.difference(parent, children[i]))
            left += planar_area(piece);
        demand(std::abs(left + covered[i] - planar_area(parent)) < 1e-6,
               "children lie in their parent, apart");
    }
}

}  // namespace
}  // namespace d2b::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace d2b::test;
    Bytes bytes(data, size);
    const bool walls = bytes.next() % 2 == 0;
    const d2b::OutlineOptions options = options_of(bytes, walls);
    const RandomGridCase c = grid_of(bytes, 20);
    d2b::Context context;
    const ContourSet set = trace_grid(c.grid, c.thresholds, {c.mode}, context);
    const d2b::Drawing drawing = walls ? d2b::Drawing::regularized : d2b::Drawing::simplified;
    check(set, d2b::Outliner(*set.list, drawing, options, unit_grid, 1, context));
    return 0;
}

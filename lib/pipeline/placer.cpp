#include "pipeline/placer.hpp"

#include <utility>

#include "pipeline/checked.hpp"
#include "pipeline/stage_clock.hpp"

namespace d2b {
namespace {

std::vector<Position> corners_of(const Window& window, const Georeference& georeference) {
    std::vector<Position> corners;
    for (const std::int32_t row : {window.row, window.row + window.rows})
        for (const std::int32_t col : {window.col, window.col + window.cols})
            corners.push_back(georeference.position({row, col}));
    return corners;
}

}  // namespace

Placer::Placer(const Placement& placement, Context& context)
    : placement_(placement),
      context_(context),
      outliner_(placement.contours, choose_drawing(placement.options, placement.georeference),
                placement.options, placement.georeference),
      geodesy_(placement.crs) {
    if (placement.target_crs.kind() != Crs::Kind::none)
        transform_.emplace(placement.crs, placement.target_crs,
                           corners_of(placement.window, placement.georeference));
}

void Placer::find_children() {
    children_.resize(placement_.contours.size());
    for (std::size_t i = 0; i < children_.size(); ++i)
        if (placement_.contours[i].parent >= 0)
            children_[static_cast<std::size_t>(placement_.contours[i].parent)].push_back(i);
}

Placer::Parts Placer::shape(std::size_t contour, bool tier, const Draw& draw) {
    std::vector<LatticePolygon> polygons{draw(contour)};
    if (tier) {
        if (children_.empty())
            find_children();
        std::vector<LatticePolygon> children;
        for (const std::size_t child : children_[contour])
            children.push_back(draw(child));
        polygons = geos_.difference(polygons.front(), children);
    }
    Parts parts;
    for (const LatticePolygon& polygon : polygons)
        parts.push_back(placement_.georeference.polygon(polygon));
    return parts;
}

Placer::Parts Placer::in_target_crs(Parts parts) {
    if (!transform_)
        return parts;
    for (WorldPolygon& part : parts) {
        transform_->apply(part.exterior);
        for (WorldRing& ring : part.interiors)
            transform_->apply(ring);
    }
    return parts;
}

Placed Placer::place(std::size_t contour, bool tier) {
    Placed placed;
    placed.status = outliner_.status();
    Parts parts;
    {
        const StageClock clock(context_.report, Stage::outline);
        parts = shape(contour, tier, [&](std::size_t c) { return outliner_.outline(c); });
        const auto traced = [&] {
            parts = shape(contour, tier, [&](std::size_t c) { return outliner_.traced(c); });
            return in_target_crs(parts);
        };
        placed.parts = checked(in_target_crs(parts), traced, geos_, placed.status, context_.report);
    }
    // Measured in the CRS of the DEM, where edges are straight.
    const StageClock clock(context_.report, Stage::attributes);
    for (const WorldPolygon& part : parts) {
        const Geodesy::Measure one = geodesy_.polygon(part);
        placed.measure.area_m2 += one.area_m2;
        placed.measure.perimeter_m += one.perimeter_m;
    }
    return placed;
}

}  // namespace d2b

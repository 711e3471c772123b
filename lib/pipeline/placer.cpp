#include "pipeline/placer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "pipeline/checked.hpp"
#include "pipeline/stage_clock.hpp"

namespace d2b {
namespace {

std::vector<Position> corners_of(const Window& window, const Georeference& georeference) {
    std::vector<Position> corners;
    for (const std::int32_t row : {window.row, window.row + window.rows})
        for (const std::int32_t col : {window.col, window.col + window.cols})
            corners.push_back(georeference.position(LatticePoint{row, col}));
    return corners;
}

/// The longest edge that is brought to another CRS in one piece, in cells: straight lines bend there, by L^2
/// / 8R or so, which is far below a cell for these.
constexpr double longest_edge_cells = 64;

/// Cuts long edges into equal parts. An edge that two outlines share is cut alike in both, whichever way they
/// run.
WorldRing with_short_edges(const WorldRing& ring, double longest) {
    WorldRing result;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position from = ring[i];
        const Position to = ring[(i + 1) % ring.size()];
        result.push_back(from);
        const int pieces =
            static_cast<int>(std::min(1e6, std::ceil(std::hypot(to.x - from.x, to.y - from.y) / longest)));
        const bool forwards = std::pair(from.x, from.y) < std::pair(to.x, to.y);
        const Position a = forwards ? from : to;
        const Position b = forwards ? to : from;
        for (int k = 1; k < pieces; ++k) {
            const double share = static_cast<double>(forwards ? k : pieces - k) / pieces;
            result.push_back({a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share});
        }
    }
    return result;
}

Geodesy::Measure measure(Geodesy& geodesy, const std::vector<WorldPolygon>& parts) {
    Geodesy::Measure sum;
    for (const WorldPolygon& part : parts) {
        const Geodesy::Measure one = geodesy.polygon(part);
        sum.area_m2 += one.area_m2;
        sum.perimeter_m += one.perimeter_m;
    }
    return sum;
}

/// Length on the ground of a unit of x over that of a unit of y.
double x_stretch(const Placement& placement) {
    constexpr double steepest = 89;  // degrees: where the poles are near, nothing is a right angle
    if (placement.crs.kind() != Crs::Kind::geographic)
        return 1;
    const Window& window = placement.window;
    const Position middle = placement.georeference.position(
        LatticePoint{window.row + window.rows / 2, window.col + window.cols / 2});
    return std::cos(std::clamp(middle.y, -steepest, steepest) * std::numbers::pi / 180);
}

Outliner make_outliner(const Placement& placement, Context& context) {
    const StageClock clock(context.report, Stage::outline);
    return {placement.contours, choose_drawing(placement.options, placement.georeference), placement.options,
            placement.georeference, x_stretch(placement)};
}

}  // namespace

Placer::Placer(const Placement& placement, Context& context)
    : placement_(placement),
      context_(context),
      outliner_(make_outliner(placement, context)),
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
    std::vector<FinePolygon> polygons{draw(contour)};
    if (tier) {
        if (children_.empty())
            find_children();
        std::vector<FinePolygon> children;
        for (const std::size_t child : children_[contour])
            children.push_back(draw(child));
        polygons = geos_.difference(polygons.front(), children);
    }
    Parts parts;
    for (const FinePolygon& polygon : polygons)
        parts.push_back(placement_.georeference.polygon(polygon));
    if (!placement_.options.arcs)
        for (WorldPolygon& part : parts)
            part.arcs.clear();
    return parts;
}

Placer::Parts Placer::in_target_crs(Parts parts) {
    if (!transform_)
        return parts;
    const double longest = longest_edge_cells * std::sqrt(placement_.georeference.cell_area());
    const auto carry = [&](WorldRing& ring) {
        ring = with_short_edges(ring, longest);
        transform_->apply(ring);
    };
    for (WorldPolygon& part : parts) {
        part.arcs.clear();  // a circle of one CRS is none in another
        carry(part.exterior);
        for (WorldRing& ring : part.interiors)
            carry(ring);
    }
    return parts;
}

Placed Placer::place(std::size_t contour, Form form) {
    const OutlineQuality quality =
        form == Form::footprint ? outliner_.footprint_quality(contour) : outliner_.quality(contour);
    Placed placed;
    placed.status = quality.status;
    if (quality.status == OutlineStatus::kept_traced)
        context_.report.count(Reason::outline_kept_traced);
    placed.deviation = quality.deviation_cells * std::sqrt(placement_.georeference.cell_area());
    placed.area_change = quality.area_change;
    const bool tier = form == Form::tier;
    Parts parts;
    {
        const StageClock clock(context_.report, Stage::outline);
        parts = shape(contour, tier, [&](std::size_t c) {
            return form == Form::footprint ? outliner_.footprint(c) : outliner_.outline(c);
        });
        const auto traced = [&] {
            parts = shape(contour, tier, [&](std::size_t c) { return outliner_.traced(c); });
            return in_target_crs(parts);
        };
        placed.parts = checked(in_target_crs(parts), traced, geos_, placed.status, context_.report);
    }
    // Measured in the CRS of the DEM, where edges are straight; a repaired polygon is known in that of the
    // output.
    const StageClock clock(context_.report, Stage::attributes);
    if (placed.status == OutlineStatus::repaired && transform_) {
        Geodesy geodesy(placement_.target_crs);
        placed.measure = measure(geodesy, placed.parts);
    } else {
        placed.measure = measure(geodesy_, placed.status == OutlineStatus::repaired ? placed.parts : parts);
    }
    return placed;
}

}  // namespace d2b

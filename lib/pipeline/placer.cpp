#include "pipeline/placer.hpp"

#include <algorithm>
#include <cmath>
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
    const double longest = longest_edge_cells * std::sqrt(placement_.georeference.cell_area());
    const auto carry = [&](WorldRing& ring) {
        ring = with_short_edges(ring, longest);
        transform_->apply(ring);
    };
    for (WorldPolygon& part : parts) {
        carry(part.exterior);
        for (WorldRing& ring : part.interiors)
            carry(ring);
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

#include "features/placer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/square_area.hpp"
#include "core/stage_clock.hpp"
#include "dem2buildings/error.hpp"
#include "features/checked.hpp"
#include "features/target_frame.hpp"

namespace d2b {
namespace {

std::vector<Position> corners_of(const Window& window, const Georeference& georeference) {
    std::vector<Position> corners;
    for (const std::int32_t row : {window.row, window.row + window.rows})
        for (const std::int32_t col : {window.col, window.col + window.cols})
            corners.push_back(georeference.position(LatticePoint{row, col}));
    return corners;
}

/// The longest edge that is brought to another CRS in one piece: straight lines bend there, by L^2 / 8R or
/// so, which is far below a cell for these. No edge gets more pieces than it passes cells.
double longest_edge(const Georeference& georeference) {
    constexpr double cells = 64;
    const Position row = georeference.step(1, 0);
    const Position col = georeference.step(0, 1);
    return std::max(
        {cells * std::sqrt(georeference.cell_area()), std::hypot(row.x, row.y), std::hypot(col.x, col.y)});
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

std::int64_t vertices_of(const std::vector<WorldPolygon>& parts) {
    std::size_t sum = 0;
    for (const WorldPolygon& part : parts) {
        sum += part.exterior.size();
        for (const WorldRing& ring : part.interiors)
            sum += ring.size();
    }
    return static_cast<std::int64_t>(sum);
}

Children::Children(const ContourList& contours) : first_(contours.size() + 1) {
    for (std::size_t i = 0; i < contours.size(); ++i)
        if (const std::int64_t parent = contours.head(i).parent; parent >= 0)
            ++first_[static_cast<std::size_t>(parent) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    children_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < contours.size(); ++i)
        if (const std::int64_t parent = contours.head(i).parent; parent >= 0)
            children_[next[static_cast<std::size_t>(parent)]++] = static_cast<std::uint32_t>(i);
}

Outliner make_outliner(const ContourList& contours, const OutlineOptions& options,
                       const Georeference& georeference, const Crs& crs, const Window& window,
                       Context& context) {
    return {contours,     choose_drawing(options, georeference), options,
            georeference, x_stretch(georeference, crs, window),  context};
}

Placer::Placer(const Placement& placement)
    : placement_(placement), geos_(placement.stop), geodesy_(placement.crs, placement.stop) {
    if (placement.target_crs.kind() == Crs::Kind::none)
        return;
    carrier_.emplace(placement.crs, placement.target_crs,
                     corners_of(placement.window, placement.georeference),
                     longest_edge(placement.georeference), placement.stop);
}

Placer::Parts Placer::shape(std::size_t contour, bool tier, const Draw& draw) {
    std::vector<FinePolygon> polygons{draw(contour)};
    if (tier) {
        std::vector<FinePolygon> children;
        for (const std::size_t child : placement_.children.of(contour))
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

/// Where GEOS cannot take away what stands on a contour, the whole of it.
Placer::Parts Placer::traced_shape(std::size_t contour, bool tier) {
    const Draw draw = [&](std::size_t c) { return placement_.outliner.traced(c); };
    try {
        return shape(contour, tier, draw);
    } catch (const GeometryError&) {
        return shape(contour, false, draw);
    }
}

/// Nothing where they are torn.
Placer::Parts Placer::in_target_crs(Parts parts) {
    if (!carrier_)
        return parts;
    const double ground_m = measure(geodesy_, parts).perimeter_m;
    double length = 0;
    const auto carry = [&](WorldRing& ring) {
        torn_ = torn_ || carrier_->carry(ring) != RingFate::whole;
        length += length_of(ring);
    };
    for (WorldPolygon& part : parts) {
        part.arcs.clear();  // a circle of one CRS is none in another
        carry(part.exterior);
        for (WorldRing& ring : part.interiors)
            carry(ring);
    }
    torn_ = torn_ || is_overstretched(length, placement_.target_crs, ground_m);
    return torn_ ? Parts() : parts;
}

/// An outline that stands as it was traced, on exact positions, is valid (docs/method.md). GEOS would need a
/// fifth of a run to find that, and for vast ones the product of their vertices and their holes.
bool Placer::is_valid_as_traced(const Placed& placed, Form form) const {
    return placed.status == OutlineStatus::traced && form != Form::tier && !carrier_ &&
           placement_.georeference.is_exact(placement_.window);
}

Placed Placer::as_traced(const LatticePolygon& polygon) {
    Placed placed;
    const StageClock clock(tally_, Stage::outline);
    torn_ = false;
    const Parts parts{placement_.georeference.polygon(polygon)};
    placed.measure = measure(geodesy_, parts);
    const auto drawn = [&] { return in_target_crs(parts); };
    Tally uncounted;  // what was dropped already was
    placed.parts = checked(drawn, drawn, geos_, placed.status, uncounted).parts;
    return placed;
}

Placed Placer::place(std::size_t contour, Form form) {
    const Outliner& outliner = placement_.outliner;
    const OutlineQuality quality =
        form == Form::footprint ? outliner.footprint_quality(contour) : outliner.quality(contour);
    Placed placed;
    torn_ = false;
    placed.status = quality.status;
    if (quality.status == OutlineStatus::kept_traced)
        tally_.count(Reason::outline_kept_traced);
    placed.deviation = quality.deviation_cells * std::sqrt(placement_.georeference.cell_area());
    placed.area_change = quality.area_change;
    placed.kept_traced = quality.kept_traced;
    const bool tier = form == Form::tier;
    Parts parts;
    {
        const StageClock clock(tally_, Stage::outline);
        const auto drawn = [&] {
            parts = shape(contour, tier, [&](std::size_t c) {
                return form == Form::footprint ? outliner.footprint(c) : outliner.outline(c);
            });
            return in_target_crs(parts);
        };
        const auto traced = [&] {
            parts = traced_shape(contour, tier);
            return in_target_crs(parts);
        };
        if (is_valid_as_traced(placed, form)) {
            placed.parts = drawn();
        } else {
            Checked found = checked(drawn, traced, geos_, placed.status, tally_);
            placed.parts = std::move(found.parts);
            placed.trouble = std::move(found.trouble);
            if (placed.status == OutlineStatus::kept_traced && !placed.trouble.empty())
                placed.kept_traced = 1;
        }
    }
    placed.torn = torn_;
    if (placed.torn)
        tally_.count(Reason::outline_torn);
    const StageClock clock(tally_, Stage::attributes);
    placed.measure = measured(placed, parts);
    return placed;
}

/// In the CRS of the DEM, where edges are straight: what GEOS repairs in that of the output says nothing of
/// the ground.
Geodesy::Measure Placer::measured(const Placed& placed, const Parts& drawn) {
    if (placed.status != OutlineStatus::repaired)
        return measure(geodesy_, drawn);
    if (!carrier_)
        return measure(geodesy_, placed.parts);
    const auto as_drawn = [&] { return drawn; };
    OutlineStatus status = OutlineStatus::traced;
    Tally uncounted;  // what was repaired already was
    return measure(geodesy_, checked(as_drawn, as_drawn, geos_, status, uncounted).parts);
}

}  // namespace d2b

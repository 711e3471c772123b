#include "features/polygon_maker.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/square_area.hpp"
#include "core/stage_clock.hpp"
#include "dem2buildings/error.hpp"
#include "features/draw_valid.hpp"
#include "features/target_frame.hpp"

namespace d2b {
namespace {

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

Outliner make_outliner(const ContourList& contours, const OutlineRules& rules,
                       const Georeference& georeference, const Crs& crs, const Window& window,
                       Context& context) {
    return {contours,     choose_drawing(rules, georeference),  rules,
            georeference, x_stretch(georeference, crs, window), context};
}

PolygonMaker::PolygonMaker(const PolygonTerms& terms)
    : terms_(terms),
      geos_(terms.stop),
      geodesy_(terms.crs, terms.stop),
      to_target_(
          output_transform(terms.crs, terms.target_crs, terms.georeference, terms.window, terms.stop)) {}

PolygonMaker::Parts PolygonMaker::shape(std::size_t contour, bool tier, const Draw& draw) {
    std::vector<FinePolygon> polygons{draw(contour)};
    if (tier) {
        std::vector<FinePolygon> children;
        for (const std::size_t child : terms_.children.of(contour))
            children.push_back(draw(child));
        polygons = geos_.difference(polygons.front(), children);
    }
    Parts parts;
    cells_.clear();
    for (const FinePolygon& polygon : polygons) {
        parts.push_back(terms_.georeference.polygon(polygon));
        if (terms_.with_cells)
            std::ranges::copy(row_spans(polygon), std::back_inserter(cells_));
    }
    if (!terms_.options.arcs)
        for (WorldPolygon& part : parts)
            part.arcs.clear();
    return parts;
}

/// Falls back to the whole contour if GEOS cannot subtract its children.
PolygonMaker::Parts PolygonMaker::traced_shape(std::size_t contour, bool tier) {
    const Draw draw = [&](std::size_t c) { return terms_.outliner.traced(c); };
    try {
        return shape(contour, tier, draw);
    } catch (const GeometryError&) {
        return shape(contour, false, draw);
    }
}

/// Returns no parts if the projection tears them.
PolygonMaker::Parts PolygonMaker::in_target_crs(Parts parts) {
    if (!to_target_)
        return parts;
    const double ground_m = measure(geodesy_, parts).perimeter_m;
    double length = 0;
    const auto carry = [&](WorldRing& ring) {
        torn_ = torn_ || to_target_->apply(ring) != RingFate::whole;
        length += length_of(ring);
    };
    for (WorldPolygon& part : parts) {
        carry(part.exterior);
        for (WorldRing& ring : part.interiors)
            carry(ring);
    }
    torn_ = torn_ || is_overstretched(length, terms_.target_crs, ground_m);
    return torn_ ? Parts() : parts;
}

/// True if validity follows from the tracing: an outline drawn as traced, on exact coordinates, is valid
/// (docs/method.md). Skipped because GEOS would need a fifth of the run time to confirm it, and for huge
/// outlines time proportional to vertices times holes.
bool PolygonMaker::is_valid_as_traced(const FeaturePolygon& made, Form form) const {
    return made.status == OutlineStatus::traced && form != Form::tier && !to_target_ &&
           terms_.georeference.is_exact(terms_.window);
}

FeaturePolygon PolygonMaker::as_traced(const LatticePolygon& polygon) {
    FeaturePolygon made;
    const StageClock clock(tally_, Stage::outline);
    torn_ = false;
    const Parts parts{terms_.georeference.polygon(polygon)};
    made.measure = measure(geodesy_, parts);
    const auto drawn = [&] { return in_target_crs(parts); };
    Tally uncounted;  // already counted when it was dropped
    made.parts = draw_valid(drawn, drawn, geos_, made.status, uncounted).parts;
    return made;
}

FeaturePolygon PolygonMaker::make(std::size_t contour, Form form) {
    const Outliner& outliner = terms_.outliner;
    const OutlineQuality quality =
        form == Form::footprint ? outliner.footprint_quality(contour) : outliner.quality(contour);
    FeaturePolygon made;
    torn_ = false;
    made.status = quality.status;
    if (quality.status == OutlineStatus::kept_traced)
        tally_.count(Reason::outline_kept_traced);
    made.deviation = quality.deviation_cells * std::sqrt(terms_.georeference.cell_area());
    made.area_change = quality.area_change;
    made.simplified = quality.simplified;
    made.kept_traced = quality.kept_traced;
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
        if (is_valid_as_traced(made, form)) {
            made.parts = drawn();
        } else {
            ValidParts found = draw_valid(drawn, traced, geos_, made.status, tally_);
            made.parts = std::move(found.parts);
            made.trouble = std::move(found.trouble);
            if (made.status == OutlineStatus::kept_traced && !made.trouble.empty())
                std::tie(made.simplified, made.kept_traced) = std::pair(0.0, 1.0);
        }
    }
    made.cells = std::exchange(cells_, {});
    made.torn = torn_;
    if (made.torn)
        tally_.count(Reason::outline_torn);
    const StageClock clock(tally_, Stage::attributes);
    made.measure = measured(made, parts);
    return made;
}

/// Measures in the CRS of the DEM, because its edges are straight and a repair in the output CRS does not
/// reflect the ground.
Geodesy::Measure PolygonMaker::measured(const FeaturePolygon& made, const Parts& drawn) {
    if (made.status != OutlineStatus::repaired)
        return measure(geodesy_, drawn);
    if (!to_target_)
        return measure(geodesy_, made.parts);
    const auto as_drawn = [&] { return drawn; };
    OutlineStatus status = OutlineStatus::traced;
    Tally uncounted;  // already counted when it was repaired
    return measure(geodesy_, draw_valid(as_drawn, as_drawn, geos_, status, uncounted).parts);
}

}  // namespace d2b

#include "features/contour_drawer.hpp"

#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "core/georeference.hpp"
#include "dem2buildings/error.hpp"
#include "features/roof_layer.hpp"

namespace d2b::features {

GroupedIndices contour_children(const contours::ContourList& contours) {
    return GroupedIndices(contours.size(), [&](const auto& add) {
        for (std::uint32_t i = 0; i < contours.size(); ++i)
            if (const std::int64_t parent = contours.head(i).parent; parent >= 0)
                add(static_cast<std::size_t>(parent), i);
    });
}

namespace {

/// @return the reason why the parts are invalid; "" if they are valid
std::string try_draw(const DrawParts& drawn, Geos& geos, std::vector<WorldPolygon>& parts) {
    try {
        parts = drawn();
        return parts.empty() ? "" : geos.invalidity(parts);
    } catch (const GeometryError& error) {
        parts.clear();
        return error.what();
    }
}

std::vector<WorldPolygon> repaired(const std::vector<WorldPolygon>& parts, Geos& geos) {
    try {
        return geos.repaired(parts);
    } catch (const GeometryError&) {
        return {};
    }
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

/// Gives the vertices of a repaired polygon the elevations of the nearest ones as drawn.
void take_elevations(const WorldPolygon& drawn, WorldPolygon& repaired) {
    std::vector<Position> vertices = drawn.exterior;
    for (const WorldRing& ring : drawn.interiors)
        vertices.insert(vertices.end(), ring.begin(), ring.end());
    const auto take = [&](const WorldRing& ring) {
        for (const Position& p : ring) {
            const auto nearest = std::ranges::min_element(
                vertices, {}, [&](const Position& q) { return std::hypot(q.x - p.x, q.y - p.y); });
            repaired.elevations.push_back(
                drawn.elevations[static_cast<std::size_t>(nearest - vertices.begin())]);
        }
    };
    take(repaired.exterior);
    for (const WorldRing& ring : repaired.interiors)
        take(ring);
}

/// True if the stack error is measured on the drawn outlines. Not for the thesis preset: its outlines are
/// drawn as traced, so the traced sums suffice, and reading the raster a second time may be expensive.
bool measures_drawn(const RunPlan& plan) {
    return plan.detects_buildings() && plan.trace == TraceMode::cells && plan.layers != Layers::buildings &&
           !plan.asked.write.has_footprints();
}

outline::OutlineRules outline_rules(const RunSetup& setup, const Context& context) {
    const OutlineOptions& asked = setup.plan.asked.outline;
    return {setup.plan.walls,
            setup.plan.wall_tolerance(setup.cell_m()),
            RunPlan::wall_price(setup.cell_m()),
            asked.wall_inset,
            asked.simplify,
            setup.target.kind() != Crs::Kind::none,
            context.report.units.vertical_metres,
            lattice_frame(setup.dem.window, setup.plan.trace)};
}

double x_stretch_of(const RunSetup& setup) {
    return x_stretch(setup.georeference, setup.crs, setup.dem.window);
}

}  // namespace

ValidParts draw_valid(const DrawParts& drawn, const DrawParts& traced, Geos& geos, OutlineStatus& status,
                      Tally& tally) {
    ValidParts result;
    result.invalid_reason = try_draw(drawn, geos, result.parts);
    if (result.invalid_reason.empty())
        return result;
    const bool redrawn = status == OutlineStatus::simplified || status == OutlineStatus::regularized;
    if (redrawn || result.parts.empty()) {
        if (try_draw(traced, geos, result.parts).empty()) {
            status = OutlineStatus::kept_traced;
            tally.count(Reason::outline_kept_traced);
            return result;
        }
    }
    status = OutlineStatus::repaired;
    tally.count(Reason::polygon_repaired);
    result.parts = repaired(result.parts, geos);
    if (result.parts.empty())
        tally.count(Reason::polygon_lost);
    return result;
}

std::int64_t vertices_of(const std::vector<WorldPolygon>& parts) {
    std::size_t sum = 0;
    for (const WorldPolygon& part : parts) {
        sum += part.exterior.size();
        for (const WorldRing& ring : part.interiors)
            sum += ring.size();
    }
    return static_cast<std::int64_t>(sum);
}

PolygonMaker::PolygonMaker(const PolygonParameters& terms)
    : terms_(terms),
      geos_(terms.stop),
      geodesy_(terms.setup.crs, terms.stop),
      to_target_(output_transform(terms.setup.crs, terms.setup.target, terms.setup.georeference,
                                  terms.setup.dem.window, terms.stop)) {}

PolygonMaker::Parts PolygonMaker::shape(std::size_t contour, bool tier, const Draw& draw) {
    std::vector<FinePolygon> polygons{draw(contour)};
    if (tier) {
        std::vector<FinePolygon> children;
        for (const std::size_t child : terms_.children[contour])
            children.push_back(draw(child));
        polygons = geos_.difference(polygons.front(), children);
    }
    Parts parts;
    cells_.clear();
    for (const FinePolygon& polygon : polygons) {
        parts.push_back(terms_.setup.georeference.polygon(polygon));
        if (terms_.with_cells)
            std::ranges::copy(row_spans(polygon), std::back_inserter(cells_));
    }
    if (!terms_.setup.plan.asked.outline.arcs)
        for (WorldPolygon& part : parts)
            part.arcs.clear();
    return area_ == nullptr ? parts : cut_off(parts);
}

PolygonMaker::Parts PolygonMaker::cut_off(const Parts& parts) {
    if (!overlay_)
        overlay_.emplace();
    return overlay_->intersection(parts, *area_);
}

FeaturePolygon PolygonMaker::within(std::size_t contour, const std::vector<WorldPolygon>& area) {
    area_ = &area;
    FeaturePolygon made = make(contour, terms_.setup.plan.asked.outline.disjoint ? Form::tier : Form::whole);
    area_ = nullptr;
    return made;
}

FeaturePolygon PolygonMaker::given(const std::vector<WorldPolygon>& area) {
    FeaturePolygon made;
    made.status = OutlineStatus::given;
    split_by_projection_ = false;
    const auto drawn = [&] { return in_target_crs(area); };
    if (to_target_) {
        const StageClock clock(tally_, Stage::outline);
        ValidParts found = draw_valid(drawn, drawn, geos_, made.status, tally_);
        made.parts = std::move(found.parts);
        made.invalid_reason = std::move(found.invalid_reason);
    } else {
        made.parts = area;
    }
    made.split_by_projection = split_by_projection_;
    if (made.split_by_projection)
        tally_.count(Reason::outline_split);
    const StageClock clock(tally_, Stage::attributes);
    made.measure = measured(made, area);
    return made;
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
    const auto project = [&](WorldRing& ring) {
        split_by_projection_ = split_by_projection_ || to_target_->apply(ring) != RingProjection::whole;
        length += length_of(ring);
    };
    for (WorldPolygon& part : parts) {
        project(part.exterior);
        for (WorldRing& ring : part.interiors)
            project(ring);
    }
    split_by_projection_ = split_by_projection_ || is_overstretched(length, terms_.setup.target, ground_m);
    return split_by_projection_ ? Parts() : parts;
}

/// True if validity follows from the tracing: an outline drawn as traced, on exact coordinates, is valid
/// (docs/method.md). Skipped because GEOS would need a fifth of the run time to confirm it, and for huge
/// outlines time proportional to vertices times holes.
bool PolygonMaker::is_valid_as_traced(const FeaturePolygon& made, Form form) const {
    return made.status == OutlineStatus::traced && form != Form::tier && !to_target_ && area_ == nullptr &&
           terms_.setup.georeference.is_exact(terms_.setup.dem.window);
}

FeaturePolygon PolygonMaker::as_traced(const LatticePolygon& polygon) {
    FeaturePolygon made;
    const StageClock clock(tally_, Stage::outline);
    split_by_projection_ = false;
    const Parts parts{terms_.setup.georeference.polygon(polygon)};
    made.measure = measure(geodesy_, parts);
    const auto drawn = [&] { return in_target_crs(parts); };
    Tally uncounted;  // already counted when it was dropped
    made.parts = draw_valid(drawn, drawn, geos_, made.status, uncounted).parts;
    return made;
}

FeaturePolygon PolygonMaker::make(std::size_t contour, Form form) {
    const outline::Outliner& outliner = terms_.outliner;
    const outline::OutlineQuality quality =
        form == Form::footprint ? outliner.footprint_quality(contour) : outliner.quality(contour);
    FeaturePolygon made;
    split_by_projection_ = false;
    made.status = quality.status;
    if (quality.status == OutlineStatus::kept_traced)
        tally_.count(Reason::outline_kept_traced);
    made.deviation = quality.deviation_cells * std::sqrt(terms_.setup.georeference.cell_area());
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
            made.invalid_reason = std::move(found.invalid_reason);
            if (made.status == OutlineStatus::kept_traced && !made.invalid_reason.empty())
                std::tie(made.simplified, made.kept_traced) = std::pair(0.0, 1.0);
        }
    }
    made.cells = std::exchange(cells_, {});
    made.split_by_projection = split_by_projection_;
    if (made.split_by_projection)
        tally_.count(Reason::outline_split);
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

FeaturePolygon PolygonMaker::roof_face(const roofs::RoofFace& face) {
    const StageClock clock(tally_, Stage::roofs);
    const Georeference& georeference = terms_.setup.georeference;
    WorldPolygon polygon = georeference.polygon(face.outline, roofs::roof_steps);
    const double metres = terms_.metres;
    const auto elevations = [&](std::span<const double> of_ring) {
        // Rings of a mirrored raster are reversed about their first vertex.
        std::vector<double> z(of_ring.begin(), of_ring.end());
        if (georeference.mirrored())
            std::reverse(z.begin() + 1, z.end());
        for (double& value : z)
            value /= metres;
        return z;
    };
    FeaturePolygon made;
    split_by_projection_ = false;
    std::size_t first = 0;
    const auto project = [&](WorldRing& ring) {
        const std::vector<double> z = elevations(std::span(face.elevations).subspan(first, ring.size()));
        first += ring.size();
        if (to_target_)
            split_by_projection_ =
                to_target_->apply_with_elevations(ring, z, polygon.elevations) != RingProjection::whole ||
                split_by_projection_;
        else
            polygon.elevations.insert(polygon.elevations.end(), z.begin(), z.end());
    };
    project(polygon.exterior);
    for (WorldRing& ring : polygon.interiors)
        project(ring);
    if (split_by_projection_) {
        tally_.count(Reason::outline_split);
        return made;
    }
    made.parts.push_back(std::move(polygon));
    if (!geos_.invalidity(made.parts).empty()) {
        const WorldPolygon drawn = std::move(made.parts.front());
        made.parts = repaired({drawn}, geos_);
        for (WorldPolygon& part : made.parts)
            take_elevations(drawn, part);
        made.status = OutlineStatus::repaired;
        tally_.count(made.parts.empty() ? Reason::polygon_lost : Reason::polygon_repaired);
    }
    return made;
}

double PolygonMaker::azimuth(const Position& at, const Position& step) {
    constexpr double degrees = 180 / std::numbers::pi;
    const RunSetup& setup = terms_.setup;
    Position image = step;
    if (to_target_) {
        // A cell is short enough for the image to be straight.
        const double scale = std::sqrt(setup.georeference.cell_area()) / std::hypot(step.x, step.y);
        const double stretch = x_stretch(setup.georeference, setup.crs, setup.dem.window);
        std::array<Position, 2> ends{at, {at.x + scale * step.x / stretch, at.y + scale * step.y}};
        if (!to_target_->apply_to_positions(ends))
            return std::numeric_limits<double>::quiet_NaN();
        const bool angles = setup.target.kind() == Crs::Kind::geographic;
        image = {(ends[1].x - ends[0].x) * (angles ? std::cos(ends[0].y / degrees) : 1),
                 ends[1].y - ends[0].y};
    }
    const double azimuth = std::atan2(image.x, image.y) * degrees;
    return azimuth < 0 ? azimuth + 360 : azimuth;
}

std::vector<PolygonMaker> polygon_makers(const RunSetup& setup, const outline::Outliner& outliner,
                                         const GroupedIndices& children, bool with_cells, Context& context) {
    std::vector<PolygonMaker> makers;
    makers.reserve(static_cast<std::size_t>(context.threads->threads()));
    for (int thread = 0; thread < context.threads->threads(); ++thread)
        makers.emplace_back(PolygonParameters{setup, outliner, children, context.threads->stop(), with_cells,
                                              context.report.units.vertical_metres});
    return makers;
}

outline::OutlineDependencies outline_dependencies_of(const contours::ContourList& contours,
                                                     const RunSetup& setup, Context& context) {
    const StageClock clock(context.report, Stage::outline);
    return outline::outline_dependencies(contours, outline_rules(setup, context), setup.georeference,
                                         x_stretch_of(setup), context.threads->stop());
}

outline::Outliner draw_outlines(const contours::ContourList& contours, const RunSetup& setup,
                                Context& context) {
    const StageClock clock(context.report, Stage::outline);
    const outline::OutlineRules rules = outline_rules(setup, context);
    return {contours,
            outline::choose_outline_method(rules, setup.georeference),
            rules,
            setup.georeference,
            x_stretch_of(setup),
            context};
}

void add_to_stack(const DrawnContour& drawn, const LayerIndices& indices, DrawnStack& stack) {
    if (drawn.building && !drawn.building->parts.empty() && indices.buildings && !drawn.is_low_confidence)
        stack.add_building(drawn.building->cells);
    if (!drawn.contour || drawn.contour->parts.empty())
        return;
    if (!indices.buildings && drawn.record.level == 1)
        stack.add_building(drawn.contour->cells);
    stack.add_contour(drawn.contour->cells, {drawn.record.tier_z, drawn.record.mean, drawn.record.level});
}

ContourDrawer::ContourDrawer(const FeatureInput& input, const RecordBuilder& records, Context& context)
    : input_(input),
      records_(records),
      threads_(*context.threads),
      children_(input.setup.plan.asked.outline.disjoint ? contour_children(input.contours)
                                                        : GroupedIndices()),
      with_cells_(measures_drawn(input.setup.plan)),
      makers_(polygon_makers(input.setup, input.outliner, children_, with_cells_, context)) {}

DrawnContour ContourDrawer::draw(std::size_t contour, std::size_t thread) {
    PolygonMaker& maker = makers_[thread];
    const contours::ContourHead& head = input_.contours.head(contour);
    DrawnContour drawn{
        head.key, head.parent, head.building, input_.is_low_confidence(contour), {}, {}, {}, {}, {}, {}, {}};
    const bool is_building = head.key.level == 1;
    {
        const StageClock clock(maker.tally(), Stage::attributes);
        const contours::StoredContours::Stored stored = input_.contours.fetch_stored(contour);
        drawn.record = records_.contour(contour, stored.contour);
        drawn.own = drawn.whole = stored.contour.own;
        drawn.whole.merge(stored.contour.above);
        if (is_building)
            drawn.building_record = records_.building(contour, stored.contour, drawn.record, stored.roof);
        if (is_building && input_.roofs != nullptr)
            drawn.building_record.roof_shape = input_.roofs->record(contour);
    }
    const LayerIndices& indices = input_.setup.layers.indices;
    if (is_building)
        draw_building(contour, maker, drawn);
    if (!indices.contours || input_.is_low_confidence(contour))
        return drawn;
    if (input_.setup.plan.asked.outline.disjoint)
        drawn.contour = maker.tier(contour);
    else
        drawn.contour =
            drawn.building && !input_.outliner.has_own_footprints() ? *drawn.building : maker.whole(contour);
    return drawn;
}

/// Restores the counters if the building is in no layer, because only written outlines are reported.
void ContourDrawer::draw_building(std::size_t contour, PolygonMaker& maker, DrawnContour& drawn) const {
    const bool is_low_confidence = input_.is_low_confidence(contour);
    const bool is_written = input_.setup.layers.indices.building_layer(is_low_confidence).has_value();
    if (!is_written && (is_low_confidence || input_.building_records == nullptr))
        return;
    const auto counted = maker.tally().dropped;
    drawn.building = maker.footprint(contour);
    if (!is_written)
        maker.tally().dropped = counted;
    else if (has_faces(drawn))
        if (const std::optional<roofs::Roof> roof = input_.roofs->roof(contour))
            drawn.faces = draw_faces(*roof, drawn.building->measure.area_m2, input_.setup, maker);
}

/// Faces tile the outline as it was drawn, so a polygon that differs from it has none.
bool ContourDrawer::has_faces(const DrawnContour& drawn) const {
    return input_.setup.layers.indices.roofs && !drawn.is_low_confidence && !drawn.building->parts.empty() &&
           drawn.building->invalid_reason.empty();
}

}  // namespace d2b::features

#include "pipeline/emit.hpp"

#include <functional>
#include <optional>
#include <utility>

#include "attributes/attribute_table.hpp"
#include "outline/outline.hpp"
#include "pipeline/stage_clock.hpp"

namespace d2b {
namespace {

using Parts = std::vector<WorldPolygon>;

std::vector<Position> corners_of(const Window& window, const Georeference& georeference) {
    std::vector<Position> corners;
    for (const std::int32_t row : {window.row, window.row + window.rows})
        for (const std::int32_t col : {window.col, window.col + window.cols})
            corners.push_back(georeference.position({row, col}));
    return corners;
}

/// Draws, places, checks and measures outlines; one object a run.
class Emitter {
  public:
    Emitter(const Emission& emission, FeatureSink& sink, Context& context)
        : emission_(emission),
          sink_(sink),
          context_(context),
          outliner_(emission.set.contours, choose_drawing(emission.options.outline, emission.georeference),
                    emission.options.outline, emission.georeference),
          geodesy_(emission.crs) {
        if (emission.target_crs.kind() != Crs::Kind::none)
            transform_.emplace(emission.crs, emission.target_crs,
                               corners_of(emission.window, emission.georeference));
        if (emission.options.outline.disjoint)
            find_children();
    }

    void begin(Layers layers);
    void emit_contour(std::size_t i, ContourRecord& record);
    void emit_building(std::size_t i, BuildingRecord& record, double threshold);
    [[nodiscard]] bool with_buildings() const { return buildings_layer_ >= 0; }
    [[nodiscard]] bool with_contours() const { return contours_layer_ >= 0; }

  private:
    using Draw = std::function<LatticePolygon(std::size_t)>;

    void find_children();
    /// The polygon of a contour, or with -disjoint what no child covers of it.
    [[nodiscard]] std::vector<LatticePolygon> shape(std::size_t i, bool tier, const Draw& draw);
    /// Places, checks and measures.
    [[nodiscard]] Parts place(std::size_t i, bool tier, OutlineStatus& status, Geodesy::Measure& measure);
    [[nodiscard]] Parts in_dem_crs(const std::vector<LatticePolygon>& polygons) const;
    [[nodiscard]] Parts in_target_crs(Parts parts);

    const Emission& emission_;
    FeatureSink& sink_;
    Context& context_;
    Outliner outliner_;
    Geos geos_;
    Geodesy geodesy_;
    std::optional<CoordinateTransform> transform_;
    std::vector<std::vector<std::size_t>> children_;
    int buildings_layer_ = -1;
    int contours_layer_ = -1;
};

void Emitter::find_children() {
    children_.resize(emission_.set.contours.size());
    for (std::size_t i = 0; i < children_.size(); ++i)
        if (emission_.set.contours[i].parent >= 0)
            children_[static_cast<std::size_t>(emission_.set.contours[i].parent)].push_back(i);
}

void Emitter::begin(Layers layers) {
    const Options& options = emission_.options;
    std::vector<LayerSpec> specs;
    if (layers != Layers::contours) {
        buildings_layer_ = static_cast<int>(specs.size());
        specs.push_back({sink_.layer_name(true, layers), "Buildings",
                         "One polygon a building, from " + context_.report.input,
                         field_specs(building_attributes(), emission_.vertical_unit), options.write.with_z});
    }
    if (layers != Layers::buildings) {
        contours_layer_ = static_cast<int>(specs.size());
        specs.push_back({sink_.layer_name(false, layers), "Contours",
                         std::string(options.outline.disjoint ? "Bands between thresholds that do not overlap, from "
                                                              : "Stacked contours, low to high, from ") +
                             context_.report.input,
                         field_specs(contour_attributes(), emission_.vertical_unit), options.write.with_z});
    }
    const StageClock clock(context_.report, Stage::write);
    sink_.begin(specs, emission_.provenance);
}

std::vector<LatticePolygon> Emitter::shape(std::size_t i, bool tier, const Draw& draw) {
    if (!tier || children_[i].empty())
        return {draw(i)};
    std::vector<LatticePolygon> children;
    for (const std::size_t child : children_[i])
        children.push_back(draw(child));
    return geos_.difference(draw(i), children);
}

Parts Emitter::in_dem_crs(const std::vector<LatticePolygon>& polygons) const {
    Parts parts;
    for (const LatticePolygon& polygon : polygons)
        parts.push_back(emission_.georeference.polygon(polygon));
    return parts;
}

Parts Emitter::in_target_crs(Parts parts) {
    if (!transform_)
        return parts;
    for (WorldPolygon& part : parts) {
        transform_->apply(part.exterior);
        for (WorldRing& ring : part.interiors)
            transform_->apply(ring);
    }
    return parts;
}

Parts Emitter::place(std::size_t i, bool tier, OutlineStatus& status, Geodesy::Measure& measure) {
    status = outliner_.status();
    Parts parts;
    Parts placed;
    {
        const StageClock clock(context_.report, Stage::outline);
        parts = in_dem_crs(shape(i, tier, [&](std::size_t c) { return outliner_.outline(c); }));
        const auto traced = [&] {
            parts = in_dem_crs(shape(i, tier, [&](std::size_t c) { return outliner_.traced(c); }));
            return in_target_crs(parts);
        };
        placed = checked(in_target_crs(parts), traced, geos_, status, context_.report);
    }
    const StageClock clock(context_.report, Stage::attributes);
    measure = {};
    for (const WorldPolygon& part : parts) {
        const Geodesy::Measure one = geodesy_.polygon(part);
        measure.area_m2 += one.area_m2;
        measure.perimeter_m += one.perimeter_m;
    }
    return placed;
}

void Emitter::emit_contour(std::size_t i, ContourRecord& record) {
    Geodesy::Measure measure;
    Feature feature;
    feature.parts = place(i, emission_.options.outline.disjoint, record.status, measure);
    record.area_m2 = measure.area_m2;
    record.perimeter_m = measure.perimeter_m;
    for (const WorldPolygon& part : feature.parts) {
        context_.report.vertices += static_cast<std::int64_t>(part.exterior.size());
        for (const WorldRing& ring : part.interiors)
            context_.report.vertices += static_cast<std::int64_t>(ring.size());
    }
    // A contour that its children cover whole has no band of its own.
    if (feature.parts.empty())
        return;
    feature.values = field_values(contour_attributes(), record);
    feature.z = record.threshold;
    const StageClock clock(context_.report, Stage::write);
    sink_.add(static_cast<std::size_t>(contours_layer_), feature);
}

void Emitter::emit_building(std::size_t i, BuildingRecord& record, double threshold) {
    Geodesy::Measure measure;
    Feature feature;
    feature.parts = place(i, false, record.status, measure);
    record.area_m2 = measure.area_m2;
    record.perimeter_m = measure.perimeter_m;
    feature.values = field_values(building_attributes(), record);
    feature.z = threshold;
    const StageClock clock(context_.report, Stage::write);
    sink_.add(static_cast<std::size_t>(buildings_layer_), feature);
}

}  // namespace

std::vector<WorldPolygon> checked(std::vector<WorldPolygon> drawn,
                                  const std::function<std::vector<WorldPolygon>()>& traced, Geos& geos,
                                  OutlineStatus& status, RunReport& report) {
    if (drawn.empty() || geos.invalidity(drawn).empty())
        return drawn;
    if (status == OutlineStatus::simplified) {
        status = OutlineStatus::kept_traced;
        report.count(Reason::outline_kept_traced);
        drawn = traced();
        if (geos.invalidity(drawn).empty())
            return drawn;
    }
    status = OutlineStatus::repaired;
    report.count(Reason::polygon_repaired);
    return geos.repaired(drawn);
}

void emit(const Emission& emission, Records& records, FeatureSink& sink, Context& context) {
    Emitter emitter(emission, sink, context);
    emitter.begin(emission.options.write.layers);
    for (std::size_t i = 0; i < records.contours.size(); ++i) {
        ContourRecord& record = records.contours[i];
        if (record.level == 1 && emitter.with_buildings())
            emitter.emit_building(i, records.buildings[static_cast<std::size_t>(emission.set.building[i])],
                                  record.threshold);
        if (emitter.with_contours())
            emitter.emit_contour(i, record);
        if (i % 64 == 0)
            context.progress(0.6 + 0.35 * static_cast<double>(i) / static_cast<double>(records.contours.size()));
    }
    const StageClock clock(context.report, Stage::write);
    sink.finish();
}

}  // namespace d2b

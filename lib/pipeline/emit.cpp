#include "pipeline/emit.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "attributes/attribute_table.hpp"
#include "pipeline/placer.hpp"
#include "pipeline/stage_clock.hpp"

namespace d2b {
namespace {

std::int64_t vertices_of(const std::vector<WorldPolygon>& parts) {
    std::size_t sum = 0;
    for (const WorldPolygon& part : parts) {
        sum += part.exterior.size();
        for (const WorldRing& ring : part.interiors)
            sum += ring.size();
    }
    return static_cast<std::int64_t>(sum);
}

/// Hands features to the layers that were asked for.
class Emitter {
  public:
    Emitter(const Emission& emission, FeatureSink& sink, Context& context)
        : emission_(emission),
          sink_(sink),
          context_(context),
          placer_({emission.set.contours, emission.options.outline, emission.georeference, emission.crs,
                   emission.target_crs, emission.window},
                  context) {}

    void begin();
    void emit_building(std::size_t contour, BuildingRecord& record, double threshold);
    /// @return whether it is in its layer
    bool emit_contour(std::size_t contour, ContourRecord& record);

  private:
    [[nodiscard]] bool is_doubtful(std::size_t contour) const {
        return emission_.set.contours[contour].label > emission_.buildings;
    }
    template <typename Record>
    void add(std::size_t layer, std::span<const Attribute<Record>> attributes, Record& record,
             Placed&& placed, double threshold);

    const Emission& emission_;
    FeatureSink& sink_;
    Context& context_;
    Placer placer_;
    std::optional<std::size_t> buildings_layer_;
    std::optional<std::size_t> contours_layer_;
    std::optional<std::size_t> doubtful_layer_;
};

void Emitter::begin() {
    const WriteOptions& write = emission_.options.write;
    const std::string& source = context_.report.input;
    // A circle of one CRS is none in another.
    const bool with_arcs = emission_.options.outline.arcs && emission_.target_crs.kind() == Crs::Kind::none;
    std::vector<LayerSpec> layers;
    const auto building_fields = field_specs(building_attributes(), emission_.vertical_unit, write.fields);
    if (write.layers != Layers::contours) {
        buildings_layer_ = layers.size();
        layers.push_back({sink_.layer_name(LayerRole::buildings, write.layers), "Buildings",
                          "One polygon a building, from " + source, building_fields, write.with_z,
                          with_arcs});
    }
    if (write.layers != Layers::buildings) {
        contours_layer_ = layers.size();
        const char* what = emission_.options.outline.disjoint
                               ? "Bands between thresholds that do not overlap, from "
                               : "Stacked contours, low to high, from ";
        layers.push_back({sink_.layer_name(LayerRole::contours, write.layers), "Contours", what + source,
                          field_specs(contour_attributes(), emission_.vertical_unit), write.with_z,
                          with_arcs});
    }
    if (write.doubtful) {
        doubtful_layer_ = layers.size();
        layers.push_back({sink_.layer_name(LayerRole::doubtful, write.layers), "Doubtful buildings",
                          "What may be a building, with the reason for the doubt, from " + source,
                          building_fields, write.with_z, with_arcs});
    }
    const StageClock clock(context_.report, Stage::write);
    sink_.begin(layers, emission_.provenance);
}

template <typename Record>
void Emitter::add(std::size_t layer, std::span<const Attribute<Record>> attributes, Record& record,
                  Placed&& placed, double threshold) {
    record.area_m2 = placed.measure.area_m2;
    record.perimeter_m = placed.measure.perimeter_m;
    record.status = placed.status;
    const StageClock clock(context_.report, Stage::write);
    sink_.add(layer, {field_values(attributes, record), std::move(placed.parts), threshold});
}

void Emitter::emit_building(std::size_t contour, BuildingRecord& record, double threshold) {
    const bool doubtful = is_doubtful(contour);
    const std::optional<std::size_t> layer = doubtful ? doubtful_layer_ : buildings_layer_;
    if (!layer)
        return;
    Placed placed = placer_.footprint(contour);
    if (placed.parts.empty())
        return;
    ++(doubtful ? context_.report.doubtful : context_.report.buildings);
    if (!contours_layer_)
        context_.report.vertices += vertices_of(placed.parts);
    record.deviation_m =
        placed.deviation / std::sqrt(emission_.georeference.cell_area()) * emission_.cell_size_m;
    record.area_change = placed.area_change;
    add(*layer, building_attributes(), record, std::move(placed), threshold);
}

bool Emitter::emit_contour(std::size_t contour, ContourRecord& record) {
    if (!contours_layer_ || is_doubtful(contour))
        return false;
    Placed placed = emission_.options.outline.disjoint ? placer_.tier(contour) : placer_.whole(contour);
    // A contour that its children cover whole has no band of its own.
    if (placed.parts.empty())
        return false;
    ++context_.report.contours;
    context_.report.vertices += vertices_of(placed.parts);
    add(*contours_layer_, contour_attributes(), record, std::move(placed), record.threshold);
    return true;
}

}  // namespace

void emit(const Emission& emission, Records& records, FeatureSink& sink, Context& context) {
    Emitter emitter(emission, sink, context);
    emitter.begin();
    // What stands on a contour that is not written stands on that contour's parent.
    std::vector<std::int64_t> written_id(records.contours.size(), 0);
    for (std::size_t i = 0; i < records.contours.size(); ++i) {
        ContourRecord& record = records.contours[i];
        const std::int64_t parent = emission.set.contours[i].parent;
        record.parent_id = parent < 0 ? 0 : written_id[static_cast<std::size_t>(parent)];
        if (record.level == 1)
            emitter.emit_building(i, records.buildings[static_cast<std::size_t>(emission.set.building[i])],
                                  record.threshold);
        written_id[i] = emitter.emit_contour(i, record) ? record.id : record.parent_id;
        if (i % 64 == 0)
            context.progress(0.6 +
                             0.35 * static_cast<double>(i) / static_cast<double>(records.contours.size()));
    }
}

}  // namespace d2b

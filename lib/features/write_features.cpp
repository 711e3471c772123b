#include "features/write_features.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/byte_stream.hpp"
#include "core/text.hpp"
#include "features/attribute_table.hpp"
#include "features/feature_writer.hpp"

namespace d2b {

void BuildingRecords::put(std::int64_t building, const BuildingRecord& record) {
    const auto index = static_cast<std::size_t>(building);
    ByteWriter writer;
    writer.put(record);
    entries_.resize(std::max(entries_.size(), index + 1));
    entries_[index] = append(*spool_, writer);
}

std::optional<BuildingRecord> BuildingRecords::of(std::int64_t building) const {
    const auto index = static_cast<std::size_t>(building);
    if (index >= entries_.size() || entries_[index].size == 0)
        return std::nullopt;
    return ByteReader(*spool_, entries_[index]).take<BuildingRecord>();
}

LayerSpecs layer_specs(const RunPlan& plan, const std::string& source, const std::string& vertical_unit,
                       const FeatureSink& sink) {
    const Options& options = plan.asked;
    const WriteOptions& write = options.write;
    const bool with_arcs = options.outline.arcs;
    LayerSpecs specs;
    const auto add = [&](LayerRole role, const char* title, const std::string& description,
                         std::vector<FieldSpec> fields, bool arcs) {
        specs.layers.push_back({sink.layer_name(role, plan.layers), title, description + utf8_text(source),
                                std::move(fields), write.with_z, arcs});
        return specs.layers.size() - 1;
    };
    const auto building_fields =
        field_specs(building_attributes(options.detect.is_split_by()), vertical_unit, write.fields);
    if (plan.layers != Layers::contours)
        specs.indices.buildings = add(LayerRole::buildings, "Buildings", "One polygon per building, from ",
                                      building_fields, with_arcs);
    if (plan.layers != Layers::buildings)
        specs.indices.contours =
            add(LayerRole::contours, "Contours",
                options.outline.disjoint ? "Bands between thresholds that do not overlap, from "
                                         : "Stacked contours, low to high, from ",
                field_specs(contour_attributes(), vertical_unit), with_arcs);
    if (write.doubtful)
        specs.indices.doubtful = add(LayerRole::doubtful, "Doubtful buildings",
                                     "Objects that may be buildings, with the reason for the doubt, from ",
                                     building_fields, with_arcs);
    if (write.rejected)
        specs.indices.rejected =
            add(LayerRole::rejected, "Rejected",
                "Contours and holes that were dropped, filled or kept as traced, with the reason, from ",
                field_specs(rejected_attributes(), vertical_unit), false);
    if (write.problems && sink.takes_points()) {
        specs.indices.problems =
            add(LayerRole::problems, "Problems",
                "Places at which outlines stood in the way of a surface, and what became of them, from ",
                field_specs(problem_attributes(), vertical_unit), false);
        specs.layers.back().points = true;
        specs.layers.back().with_z = false;
    }
    return specs;
}

void write_features(const FeatureInput& input, const RecordBuilder& records, FeatureSink& sink,
                    Context& context) {
    constexpr std::size_t chunk_size = 64;  // contours per task
    FeatureWriter writer(input, records, sink, context);
    writer.begin();
    AssignedIds numbers;
    const std::size_t count = input.contours.size();
    context.threads->in_order(
        (count + chunk_size - 1) / chunk_size,
        [&](std::size_t k, std::size_t thread) {
            std::vector<DrawnContour> drawn;
            for (std::size_t i = k * chunk_size; i < std::min(count, (k + 1) * chunk_size); ++i)
                drawn.push_back(writer.drawer().draw(i, thread));
            return drawn;
        },
        [&](std::size_t k, std::vector<DrawnContour> drawn) {
            for (std::size_t i = 0; i < drawn.size(); ++i)
                writer.add(numbers, k * chunk_size + i, std::move(drawn[i]));
            context.progress(static_cast<double>(k * chunk_size) / static_cast<double>(count));
        });
    writer.finish();
}

namespace {

constexpr double building_label_scale = 2500;  ///< scale denominator up to which labels are shown
constexpr double contour_label_scale = 1000;

/// Returns metres per map unit; 1 if map units are angles, because 3D views do not support these.
double map_metres(const FeatureInput& input) {
    const bool as_read = input.target_crs.kind() == Crs::Kind::none;
    const auto unit = (as_read ? input.crs : input.target_crs).horizontal_unit();
    return unit && unit->metres > 0 ? unit->metres : 1;
}

/// Style of a layer of features with a reason but without a height.
LayerStyle reason_style(const char* title, const char* field, double label_scale) {
    LayerStyle style;
    style.title = title;
    style.label = field;
    style.label_scale = label_scale;
    return style;
}

}  // namespace

LayerStyle building_style(FieldNames names) {
    LayerStyle style;
    style.title = "Height above ground, 90th percentile, m";
    // Height of the whole building, because the maximum of a church is that of its spire.
    style.colour = style.label = style.height = field_name(names, "p90");
    style.certainty = "confidence";
    style.certain = sure_confidence;
    style.label_scale = building_label_scale;
    return style;
}

LayerStyle contour_style(bool disjoint) {
    LayerStyle style;
    style.title = "Height of the part above ground, m";
    style.colour = style.label = style.height = "height";
    style.certainty = "confidence";
    style.certain = sure_confidence;
    style.label_scale = contour_label_scale;
    style.order = "level";
    style.top = "top";
    // Bands do not lie on each other, so each extends down to the ground.
    if (disjoint)
        return style;
    style.min_height = "min_height";
    // Labels only contours without others on top, because higher contours cover the others and their labels.
    // Without contours on top, a contour's own mean equals that of all its points.
    style.labelled = {"elev_mean", "tier_z"};
    return style;
}

void give_styles(std::vector<LayerSpec>& layers, const FeatureInput& input, double vertical_metres) {
    const LayerIndices& indices = input.layers.indices;
    if (indices.buildings) {
        LayerStyle& style = layers[*indices.buildings].style = building_style(input.plan.asked.write.fields);
        // Only without contours, because a block and the stack inside it would overlap.
        if (!indices.contours)
            style.bottom = "ground";
    }
    if (indices.contours)
        layers[*indices.contours].style = contour_style(input.plan.asked.outline.disjoint);
    if (indices.doubtful)
        layers[*indices.doubtful].style = reason_style("May be buildings", "doubt", building_label_scale);
    if (indices.rejected)
        layers[*indices.rejected].style =
            reason_style("Dropped, filled or kept as traced", "reason", contour_label_scale);
    if (indices.problems)
        layers[*indices.problems].style =
            reason_style("In the way of a surface", "kind", contour_label_scale);
    for (LayerSpec& layer : layers) {
        layer.style.metre_scale = 1 / map_metres(input);
        layer.style.vertical_scale = vertical_metres / map_metres(input);
    }
}

}  // namespace d2b

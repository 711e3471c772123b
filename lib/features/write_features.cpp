#include "features/write_features.hpp"

#include <algorithm>
#include <string>

#include "core/byte_stream.hpp"
#include "core/text.hpp"
#include "features/attribute_table.hpp"
#include "features/feature_writer.hpp"

namespace d2b::features {

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

std::optional<DrawnStack> write_features(const FeatureInput& input, const RecordBuilder& records,
                                         FeatureSink& sink, Context& context) {
    FeatureWriter writer(input, records, sink, context);
    writer.begin();
    AssignedIds numbers;
    writer.drawer().draw_all([&](std::size_t i, DrawnContour&& drawn) {
        writer.add(numbers, i, std::move(drawn));
        if (i % contours_per_task == 0)
            context.progress(static_cast<double>(i) / static_cast<double>(input.contours.size()));
    });
    return writer.finish();
}

namespace {

constexpr double building_label_scale = 2500;  ///< scale denominator up to which labels are shown
constexpr double contour_label_scale = 1000;

/// Returns metres per map unit; 1 if map units are angles, because 3D views do not support these.
double map_metres(const FeatureInput& input) {
    const auto unit = input.setup.written().horizontal_unit();
    return unit && unit->metres > 0 ? unit->metres : 1;
}

/// Returns the name of a field of given footprints, which may have a prefix.
std::string field_called(const std::string& name, const LayerSpec& layer) {
    const auto found = std::ranges::find_if(layer.fields, [&](const FieldSpec& field) {
        return field.name == name || field.name.ends_with("d2b_" + name);
    });
    return found == layer.fields.end() ? name : found->name;
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

LayerStyle roof_style() {
    LayerStyle style;
    style.title = "Direction in which roofs slope";
    style.slope = style.label = "slope";
    style.azimuth = "azimuth";
    style.label_scale = contour_label_scale;
    return style;
}

void give_styles(std::vector<LayerSpec>& layers, const FeatureInput& input, double vertical_metres) {
    const LayerIndices& indices = input.setup.layers.indices;
    if (indices.buildings) {
        LayerStyle& style = layers[*indices.buildings].style =
            building_style(input.setup.plan.asked.write.fields);
        // Only without contours, because a block and the stack inside it would overlap.
        if (!indices.contours)
            style.bottom = "ground";
    }
    if (indices.given) {
        LayerStyle& style = layers[*indices.given].style =
            building_style(input.setup.plan.asked.write.fields);
        style.certainty.clear();
        style.colour = style.label = style.height = field_called(style.height, layers[*indices.given]);
        if (!indices.given_contours)
            style.bottom = field_called("ground", layers[*indices.given]);
    }
    if (const auto contours = indices.contours ? indices.contours : indices.given_contours)
        layers[*contours].style = contour_style(input.setup.plan.asked.outline.disjoint);
    if (const auto roofs = indices.roofs ? indices.roofs : indices.given_roofs)
        layers[*roofs].style = roof_style();
    if (indices.doubtful)
        layers[*indices.doubtful].style = reason_style("May be buildings", "doubt", building_label_scale);
    if (indices.rejected)
        layers[*indices.rejected].style =
            reason_style("Dropped, filled or kept as traced", "reason", contour_label_scale);
    if (indices.problems)
        layers[*indices.problems].style = reason_style("Unfit for a surface", "kind", contour_label_scale);
    // Labels of two layers would lie on each other. Doubtful objects are never buildings.
    if (indices.buildings)
        for (const auto& other : {indices.contours, indices.roofs, indices.rejected})
            if (other)
                layers[*other].style.labels_on = false;
    for (LayerSpec& layer : layers) {
        layer.style.metre_scale = 1 / map_metres(input);
        layer.style.vertical_scale = vertical_metres / map_metres(input);
    }
}

}  // namespace d2b::features

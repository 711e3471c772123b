#include "features/layer_styles.hpp"

#include <string>

#include "attributes/attribute_table.hpp"
#include "attributes/field_names.hpp"

namespace d2b {
namespace {

constexpr double buildings_scale = 2500;  ///< scale denominator up to which labels are shown
constexpr double parts_scale = 1000;

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
    style.label_scale = buildings_scale;
    return style;
}

LayerStyle contour_style(bool disjoint) {
    LayerStyle style;
    style.title = "Height of the part above ground, m";
    style.colour = style.label = style.height = "height";
    style.certainty = "confidence";
    style.certain = sure_confidence;
    style.label_scale = parts_scale;
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
    const LayerPlaces& places = input.layers.places;
    if (places.buildings) {
        LayerStyle& style = layers[*places.buildings].style = building_style(input.plan.asked.write.fields);
        // Only without contours, because a block and the stack inside it would overlap.
        if (!places.contours)
            style.bottom = "ground";
    }
    if (places.contours)
        layers[*places.contours].style = contour_style(input.plan.asked.outline.disjoint);
    if (places.doubtful)
        layers[*places.doubtful].style = reason_style("May be buildings", "doubt", buildings_scale);
    if (places.rejected)
        layers[*places.rejected].style =
            reason_style("Dropped, filled or kept as traced", "reason", parts_scale);
    if (places.problems)
        layers[*places.problems].style = reason_style("In the way of a surface", "kind", parts_scale);
    for (LayerSpec& layer : layers) {
        layer.style.metre_scale = 1 / map_metres(input);
        layer.style.vertical_scale = vertical_metres / map_metres(input);
    }
}

}  // namespace d2b

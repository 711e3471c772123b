#include "features/layer_styles.hpp"

#include <string>

#include "attributes/field_names.hpp"

namespace d2b {
namespace {

constexpr double buildings_scale = 2500;  ///< labels are written from here on
constexpr double parts_scale = 1000;

/// Metres in a unit of the map; 1 where the map has angles, which no 3D view shows.
double map_metres(const FeatureInput& input) {
    const bool as_read = input.target_crs.kind() == Crs::Kind::none;
    const auto unit = (as_read ? input.crs : input.target_crs).horizontal_unit();
    return unit && unit->metres > 0 ? unit->metres : 1;
}

LayerStyle building_style(FieldNames names) {
    LayerStyle style;
    style.title = "Height of buildings";
    style.colour = style.label = style.height = field_name(names, "height");
    style.label_scale = buildings_scale;
    return style;
}

LayerStyle contour_style(bool disjoint) {
    LayerStyle style;
    style.title = "Height of parts";
    style.colour = style.label = style.height = "height";
    style.label_scale = parts_scale;
    style.order = "level";
    style.top = "top";
    // Nothing of another band is below a band: each stands on the ground.
    if (!disjoint)
        style.min_height = "min_height";
    return style;
}

/// Of what has a reason and no height.
LayerStyle reason_style(const char* title, const char* field, double label_scale) {
    LayerStyle style;
    style.title = title;
    style.label = field;
    style.label_scale = label_scale;
    return style;
}

}  // namespace

void give_styles(std::vector<LayerSpec>& layers, const LayerPlaces& places, const FeatureInput& input,
                 double vertical_metres) {
    if (places.buildings) {
        LayerStyle& style = layers[*places.buildings].style = building_style(input.plan.asked.write.fields);
        // A block and the stack within it would stand in one place.
        if (!places.contours)
            style.top = "roof";
    }
    if (places.contours)
        layers[*places.contours].style = contour_style(input.plan.asked.outline.disjoint);
    if (places.doubtful)
        layers[*places.doubtful].style = reason_style("May be buildings", "doubt", buildings_scale);
    if (places.rejected)
        layers[*places.rejected].style =
            reason_style("Dropped, filled or kept as traced", "reason", parts_scale);
    for (LayerSpec& layer : layers) {
        layer.style.metre_scale = 1 / map_metres(input);
        layer.style.vertical_scale = vertical_metres / map_metres(input);
    }
}

}  // namespace d2b

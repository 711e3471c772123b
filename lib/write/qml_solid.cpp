#include "core/height_classes.hpp"
#include "core/number_text.hpp"
#include "write/qml_parts.hpp"

namespace d2b::qml {

namespace {

std::string scaled(const std::string& expression, double scale) {
    return scale == 1 ? expression : expression + " * " + number_text(scale);
}

std::string material(std::size_t height_class) {
    const auto& colour = height_classes()[height_class].colour;
    const auto shade = [&](double share) {
        std::string text;
        for (const unsigned char part : colour)
            text += std::to_string(static_cast<int>(part * share)) + ",";
        return text + "255";
    };
    return "     <material ambient=\"" + shade(0.35) + "\" diffuse=\"" + shade(0.85) +
           "\" specular=\"20,20,20,255\" shininess=\"0\" opacity=\"1\"/>\n";
}

/// QGIS up to 3.40 reads `height`, later versions `offset`; both are only fallbacks for expressions without a
/// result.
std::string solid(std::size_t height_class, const std::string& altitude, const std::string& extrusion) {
    return "    <symbol type=\"polygon\" material_type=\"phong\">\n"
           "     <data alt-clamping=\"absolute\" alt-binding=\"centroid\" height=\"0\" offset=\"0\" "
           "extrusion-height=\"0\" culling-mode=\"no-culling\" invert-normals=\"0\" add-back-faces=\"0\" "
           "rendered-facade=\"3\"/>\n" +
           material(height_class) +
           defined_properties("data-defined-properties", defined_property("height", altitude) +
                                                             defined_property("extrusionHeight", extrusion)) +
           "     <edges enabled=\"0\" width=\"1\" color=\"70,45,35,255\"/>\n    </symbol>\n";
}

}  // namespace

std::string renderer_3d(const LayerSpec& spec, const Columns& columns) {
    const LayerStyle& style = spec.style;
    // Each solid reaches from the top of the one below to its own top, so that neighbours meet in an
    // invisible plane and no two walls coincide.
    const std::string thickness =
        columns.min_height.empty() ? columns.height : "(" + columns.height + " - " + columns.min_height + ")";
    const std::string extrusion = scaled(thickness, style.metre_scale);
    // QGIS adds the Z of the vertices to an absolute altitude; all vertices of a feature have the same Z.
    const std::string altitude =
        (columns.top.empty() ? scaled(columns.bottom, style.vertical_scale)
                             : scaled(columns.top, style.vertical_scale) + " - " + extrusion) +
        (spec.with_z ? " - z(point_n($geometry, 1))" : "");
    std::string text =
        " <renderer-3d type=\"rulebased\" layer=\"\">\n"
        "  <vector-layer-3d-tiling zoom-levels-count=\"3\" show-bounding-boxes=\"0\"/>\n"
        "  <rules key=\"{dem2buildings}\">\n";
    for (std::size_t i = 0; i < height_classes().size(); ++i)
        text += "   <rule key=\"{dem2buildings-" + std::to_string(i) + "}\" description=\"" + class_label(i) +
                "\" filter=\"" + class_filter(i, columns.height) + "\">\n" + solid(i, altitude, extrusion) +
                "   </rule>\n";
    return text + "  </rules>\n </renderer-3d>\n";
}

}  // namespace d2b::qml

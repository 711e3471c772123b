#include <utility>
#include <vector>

#include "core/height_classes.hpp"
#include "core/number_text.hpp"
#include "write/qml_parts.hpp"
#include "write/xml_text.hpp"

namespace d2b::qml {

namespace {

using Properties = std::vector<std::pair<std::string, std::string>>;

/// Writes properties as options and, for QGIS before 3.20, as `prop` elements.
std::string symbol_layer(const std::string& kind, const Properties& properties,
                         const std::string& defined = "") {
    std::string options;
    std::string props;
    for (const auto& [key, value] : properties) {
        options += "      <Option type=\"QString\" name=\"" + key + "\" value=\"" + value + "\"/>\n";
        props += "     <prop k=\"" + key + "\" v=\"" + value + "\"/>\n";
    }
    return "    <layer class=\"" + kind +
           "\" enabled=\"1\" locked=\"0\" pass=\"0\">\n     <Option type=\"Map\">\n" + options +
           "     </Option>\n" + props + defined + "    </layer>\n";
}

/// @param colour "" for no fill @param width of the outline in millimetres; "" for none
std::string area(const std::string& colour, const std::string& edge, const std::string& width,
                 const std::string& defined = "") {
    return symbol_layer("SimpleFill",
                        {{"color", colour.empty() ? "0,0,0,0" : colour},
                         {"style", colour.empty() ? "no" : "solid"},
                         {"joinstyle", "miter"},
                         {"outline_color", edge},
                         {"outline_style", width.empty() ? "no" : "solid"},
                         {"outline_width", width.empty() ? "0" : width},
                         {"outline_width_unit", "MM"}},
                        defined);
}

std::string symbol(std::size_t number, const std::string& layers, const std::string& type = "fill") {
    return "   <symbol type=\"" + type + "\" name=\"" + std::to_string(number) +
           "\" alpha=\"1\" clip_to_extent=\"1\" force_rhr=\"0\">\n" + layers + "   </symbol>\n";
}

/// Hollow marker, so that the map below stays visible.
std::string dot() {
    return symbol_layer("SimpleMarker", {{"name", "circle"},
                                         {"color", "255,255,255,0"},
                                         {"outline_color", "174,1,126,255"},
                                         {"outline_style", "solid"},
                                         {"outline_width", "0.5"},
                                         {"outline_width_unit", "MM"},
                                         {"size", "3"},
                                         {"size_unit", "MM"}});
}

/// Hatching in millimetres, so that it looks the same in print and on screen, on a translucent white that
/// covers the relief.
std::string hatched() {
    constexpr const char* magenta = "174,1,126,255";
    return area("255,255,255,130", magenta, "") +
           symbol_layer("LinePatternFill", {{"angle", "45"},
                                            {"color", magenta},
                                            {"distance", "1.3"},
                                            {"distance_unit", "MM"},
                                            {"line_width", "0.35"},
                                            {"line_width_unit", "MM"}}) +
           area("", magenta, "0.4");
}

/// White overlay on uncertain features: the less certain, the whiter.
std::string veil(const LayerStyle& style, const std::string& certainty) {
    constexpr Veil opacity;
    const std::string colour = "color_rgba(255, 255, 255, scale_linear(" + certainty + ", " +
                               number_text(opacity.low) + ", " + number_text(style.certain) + ", " +
                               number_text(opacity.most) + ", " + number_text(opacity.least) + "))";
    return area("255,255,255,130", "150,135,130,255", "0.12",
                defined_properties("data_defined_properties", defined_property("fillColor", colour)));
}

std::string rule(std::size_t number, const std::string& filter, const std::string& label) {
    const std::string text = std::to_string(number);
    return "    <rule key=\"{dem2buildings-" + text + "}\" symbol=\"" + text + "\" filter=\"" + filter +
           "\" label=\"" + xml_text(label) + "\"/>\n";
}

/// Thins outlines on small scales, because dense outlines would cover the colours.
std::string thin_on_small_maps() {
    return defined_properties(
        "data_defined_properties",
        defined_property("outlineWidth", "coalesce(scale_linear(@map_scale, 1000, 5000, 0.16, 0.04), 0.12)"));
}

/// One rule per class, below a rule that is only the heading of the legend.
std::string by_height(const LayerStyle& style, const Columns& columns) {
    const std::size_t classes = height_classes().size();
    std::string rules;
    std::string symbols;
    for (std::size_t i = 0; i < classes; ++i) {
        rules += rule(i, class_filter(i, columns.colour), class_label(i));
        symbols += symbol(i, area(colour_text(i), "70,45,35,255", "0.12", thin_on_small_maps()));
    }
    if (!columns.certainty.empty()) {
        rules += rule(classes,
                      columns.certainty + " &lt; " + number_text(style.certain) + " AND " + columns.colour +
                          " IS NOT NULL",
                      "paler: less certain");
        symbols += symbol(classes, veil(style, columns.certainty));
    }
    return "  <rules key=\"{dem2buildings}\">\n   <rule key=\"{dem2buildings-heading}\" label=\"" +
           xml_text(style.title) + "\">\n" + rules + "   </rule>\n  </rules>\n  <symbols>\n" + symbols +
           "  </symbols>\n";
}

}  // namespace

std::string renderer(const LayerSpec& spec, const Columns& columns) {
    const LayerStyle& style = spec.style;
    const bool ordered = !columns.order.empty();
    const std::string order = ordered ? "1" : "0";
    std::string text =
        " <renderer-v2 forceraster=\"0\" symbollevels=\"0\" enableorderby=\"" + order + "\" type=\"";
    if (spec.points)
        text += "singleSymbol\">\n  <symbols>\n" + symbol(0, dot(), "marker") + "  </symbols>\n";
    else if (columns.colour.empty())
        text += "singleSymbol\">\n  <symbols>\n" + symbol(0, hatched()) + "  </symbols>\n";
    else
        text += "RuleRenderer\">\n" + by_height(style, columns);
    if (ordered)
        text += "  <orderby>\n   <orderByClause asc=\"1\" nullsFirst=\"1\">" + columns.order +
                "</orderByClause>\n  </orderby>\n";
    return text + " </renderer-v2>\n";
}

}  // namespace d2b::qml

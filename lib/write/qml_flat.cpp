#include <algorithm>
#include <limits>

#include "core/height_classes.hpp"
#include "core/number_text.hpp"
#include "write/qml_parts.hpp"
#include "write/xml_text.hpp"

namespace d2b::qml {

namespace {

/// Above every building, for a class without end.
constexpr double no_end = 1e6;

using Properties = std::vector<std::pair<std::string, std::string>>;

/// As maps of options and, for QGIS before 3.20, as `prop` elements.
std::string symbol_layer(const std::string& kind, const Properties& properties) {
    std::string options;
    std::string props;
    for (const auto& [key, value] : properties) {
        options += "      <Option type=\"QString\" name=\"" + key + "\" value=\"" + value + "\"/>\n";
        props += "     <prop k=\"" + key + "\" v=\"" + value + "\"/>\n";
    }
    return "    <layer class=\"" + kind +
           "\" enabled=\"1\" locked=\"0\" pass=\"0\">\n     <Option type=\"Map\">\n" + options +
           "     </Option>\n" + props + "    </layer>\n";
}

std::string symbol(std::size_t number, const std::string& layer) {
    return "   <symbol type=\"fill\" name=\"" + std::to_string(number) +
           "\" alpha=\"1\" clip_to_extent=\"1\" force_rhr=\"0\">\n" + layer + "   </symbol>\n";
}

std::string filled(std::size_t height_class) {
    return symbol_layer("SimpleFill", {{"color", colour_text(height_class)},
                                       {"style", "solid"},
                                       {"joinstyle", "miter"},
                                       {"outline_color", "70,45,35,255"},
                                       {"outline_style", "solid"},
                                       {"outline_width", "0.12"},
                                       {"outline_width_unit", "MM"}});
}

std::string hatched() {
    return symbol_layer("SimpleFill", {{"color", "122,1,119,255"},
                                       {"style", "b_diagonal"},
                                       {"joinstyle", "miter"},
                                       {"outline_color", "122,1,119,255"},
                                       {"outline_style", "dash"},
                                       {"outline_width", "0.3"},
                                       {"outline_width_unit", "MM"}});
}

std::string by_height(const std::string& attribute) {
    const auto classes = height_classes();
    std::string ranges;
    std::string symbols;
    for (std::size_t i = 0; i < classes.size(); ++i) {
        const double from = i == 0 ? -no_end : classes[i].from;
        const double to = i + 1 < classes.size() ? classes[i + 1].from : no_end;
        ranges += "   <range symbol=\"" + std::to_string(i) + "\" render=\"true\" lower=\"" +
                  number_text(from) + "\" upper=\"" + number_text(to) + "\" label=\"" +
                  xml_text(class_label(i)) + "\"/>\n";
        symbols += symbol(i, filled(i));
    }
    return attribute + ">\n  <ranges>\n" + ranges + "  </ranges>\n  <symbols>\n" + symbols +
           "  </symbols>\n  <classificationMethod id=\"Custom\"/>\n";
}

}  // namespace

std::string colour_text(std::size_t height_class) {
    const auto& [red, green, blue] = height_classes()[height_class].colour;
    return std::to_string(red) + "," + std::to_string(green) + "," + std::to_string(blue) + ",255";
}

std::string renderer(const Columns& columns) {
    const bool ordered = !columns.order.empty();
    std::string text = " <renderer-v2 forceraster=\"0\" symbollevels=\"0\" enableorderby=\"" +
                       std::string(ordered ? "1" : "0") + "\" type=\"";
    if (columns.colour.empty())
        text += "singleSymbol\">\n  <symbols>\n" + symbol(0, hatched()) + "  </symbols>\n";
    else
        text +=
            by_height("graduatedSymbol\" graduatedMethod=\"GraduatedColor\" attr=\"" + columns.colour + "\"");
    if (ordered)
        text += "  <orderby>\n   <orderByClause asc=\"1\" nullsFirst=\"1\">" + columns.order +
                "</orderByClause>\n  </orderby>\n";
    return text + " </renderer-v2>\n";
}

std::string labeling(const LayerSpec& spec, const Columns& columns) {
    const auto field = std::ranges::find(spec.fields, spec.style.label, &FieldSpec::name);
    const bool text = field->type == FieldType::text;
    const std::string expression = text ? columns.label : "round(" + columns.label + ") || ' m'";
    // A halo, so that figures can be read on every colour of the legend.
    return " <labeling type=\"simple\">\n  <settings calloutType=\"simple\">\n"
           "   <text-style fieldName=\"" +
           expression +
           "\" isExpression=\"1\" fontFamily=\"Sans Serif\" fontSize=\"8\" fontSizeUnit=\"Point\" "
           "fontWeight=\"50\" textColor=\"30,30,30,255\" textOpacity=\"1\" namedStyle=\"\">\n"
           "    <text-buffer bufferDraw=\"1\" bufferSize=\"0.6\" bufferSizeUnits=\"MM\" "
           "bufferColor=\"255,255,255,255\" bufferOpacity=\"0.9\" bufferJoinStyle=\"128\"/>\n"
           "   </text-style>\n"
           "   <text-format/>\n"
           "   <placement placement=\"1\" placementFlags=\"10\" centroidInside=\"1\" centroidWhole=\"1\" "
           "fitInPolygonOnly=\"0\" quadOffset=\"4\" priority=\"5\" polygonPlacementFlags=\"2\"/>\n"
           "   <rendering scaleVisibility=\"1\" scaleMin=\"1\" scaleMax=\"" +
           number_text(spec.style.label_scale) +
           "\" obstacle=\"0\" drawLabels=\"1\" displayAll=\"0\" labelPerPart=\"0\"/>\n"
           "  </settings>\n </labeling>\n";
}

}  // namespace d2b::qml

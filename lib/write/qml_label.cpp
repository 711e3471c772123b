#include <algorithm>

#include "core/height_classes.hpp"
#include "core/number_text.hpp"
#include "write/qml_parts.hpp"

namespace d2b::qml {

namespace {

/// Expression for a height in whole metres. Keeps a decimal if rounding would lift it into the next class, so
/// that label and colour agree: 9.7 m does not become 10.
std::string height_text(const std::string& height) {
    std::string bounds;
    for (const HeightClass& one : height_classes().subspan(1))
        bounds += (bounds.empty() ? "" : ", ") + number_text(one.from);
    const std::string whole = "round(" + height + ")";
    return "CASE WHEN " + height + " &lt; " + whole + " AND " + whole + " IN (" + bounds + ") THEN floor(" +
           height + " * 10) / 10 ELSE " + whole + " END || ' m'";
}

}  // namespace

std::string labeling(const LayerSpec& spec, const Columns& columns) {
    const auto field = std::ranges::find(spec.fields, spec.style.label, &FieldSpec::name);
    const bool text = field->type == FieldType::text;
    std::string expression = text ? columns.label : height_text(columns.label);
    if (const auto& [one, other] = columns.labelled; !one.empty() && !other.empty())
        expression = "CASE WHEN " + one + " = " + other + " THEN " + expression + " END";
    // The halo makes labels readable on every colour of the legend.
    return " <labeling type=\"simple\">\n  <settings calloutType=\"simple\">\n"
           "   <text-style fieldName=\"" +
           expression +
           "\" isExpression=\"1\" fontFamily=\"Sans Serif\" fontSize=\"8\" fontSizeUnit=\"Point\" "
           "fontWeight=\"50\" textColor=\"30,30,30,255\" textOpacity=\"1\" namedStyle=\"\">\n"
           "    <text-buffer bufferDraw=\"1\" bufferSize=\"0.6\" bufferSizeUnits=\"MM\" "
           "bufferColor=\"255,255,255,255\" bufferOpacity=\"0.9\" bufferJoinStyle=\"128\"/>\n"
           "   </text-style>\n"
           "   <text-format/>\n"
           "   <placement placement=\"" +
           (spec.points ? "0" : "1") +
           "\" placementFlags=\"10\" centroidInside=\"1\" centroidWhole=\"1\" "
           "fitInPolygonOnly=\"0\" quadOffset=\"4\" priority=\"5\" polygonPlacementFlags=\"2\"/>\n"
           "   <rendering scaleVisibility=\"1\" scaleMin=\"1\" scaleMax=\"" +
           number_text(spec.style.label_scale) +
           "\" obstacle=\"0\" drawLabels=\"1\" displayAll=\"0\" labelPerPart=\"0\"/>\n"
           "  </settings>\n </labeling>\n";
}

}  // namespace d2b::qml

#include "write/qml_style.hpp"

#include <algorithm>

#include "write/qml_parts.hpp"
#include "write/xml_text.hpp"

namespace d2b {

namespace {

/// Returns a field as a quoted name in an expression.
std::string column(const LayerSpec& spec, const std::vector<std::string>& columns, const std::string& name) {
    const auto field = std::ranges::find(spec.fields, name, &FieldSpec::name);
    if (name.empty() || field == spec.fields.end())
        return "";
    std::string quoted = "\"";
    for (const char letter : columns[static_cast<std::size_t>(field - spec.fields.begin())])
        quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
    return xml_text(quoted + "\"");
}

/// Returns the aliases of fields, with their units.
std::string aliases(const LayerSpec& spec, const std::vector<std::string>& columns) {
    std::string text = " <aliases>\n";
    for (std::size_t i = 0; i < spec.fields.size(); ++i)
        text += "  <alias field=\"" + xml_text(columns[i]) + "\" index=\"" + std::to_string(i) +
                "\" name=\"" + xml_text(spec.fields[i].alias) + "\"/>\n";
    return text + " </aliases>\n";
}

/// Returns the tooltip of a feature in QGIS.
std::string map_tip(const qml::Columns& columns) {
    return columns.height.empty() ? "" : " <mapTip>[% round(" + columns.height + ", 1) %] m</mapTip>\n";
}

}  // namespace

std::string qml_style(const LayerSpec& spec, const std::vector<std::string>& columns) {
    const LayerStyle& style = spec.style;
    const auto named = [&](const std::string& name) { return column(spec, columns, name); };
    const qml::Columns fields{.colour = named(style.colour),
                              .label = named(style.label),
                              .labelled = {named(style.labelled[0]), named(style.labelled[1])},
                              .order = named(style.order),
                              .certainty = named(style.certainty),
                              .top = named(style.top),
                              .bottom = named(style.bottom),
                              .height = named(style.height),
                              .min_height = named(style.min_height)};
    std::string text = "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n";
    text += style_mark;
    text += "<qgis version=\"3.16.0\" labelsEnabled=\"" + std::string(fields.label.empty() ? "0" : "1") +
            "\" hasScaleBasedVisibilityFlag=\"0\">\n";
    if (!(fields.top + fields.bottom).empty() && !fields.height.empty())
        text += qml::renderer_3d(spec, fields);
    text += qml::renderer(spec, fields);
    if (!fields.label.empty())
        text += qml::labeling(spec, fields);
    text += aliases(spec, columns) + map_tip(fields);
    return text + " <layerGeometryType>" + (spec.points ? "0" : "2") + "</layerGeometryType>\n</qgis>\n";
}

}  // namespace d2b

#include "write/qgis/qgis_style.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <span>
#include <system_error>
#include <utility>

#include <cpl_vsi.h>

#include "core/height_classes.hpp"
#include "core/height_text.hpp"
#include "core/text.hpp"
#include "read/gdal_messages.hpp"
#include "write/xml_text.hpp"

/// Parts of QML documents.
namespace d2b::qml {
namespace {

/// Fields used by a style, as quoted columns in an expression of QGIS, escaped for XML; "" if the style does
/// not use the field.
struct Columns {
    std::string colour;
    std::string label;
    std::string median;  ///< of the heights of a building whose p90 is the label; "" in other layers
    std::array<std::string, 2> labelled;
    std::string order;
    std::string certainty;
    std::string slope;
    std::string azimuth;
    std::string classified;
    std::string top;
    std::string bottom;
    std::string height;
    std::string min_height;
    bool by_sun = false;  ///< colours faces by their suitability for panels, not by their direction
    std::span<const HeightClass> classes = height_classes();
};

/// Returns for example "255,237,160,255".
std::string colour_text(const HeightClass& height_class) {
    const auto& [red, green, blue] = height_class.colour;
    return std::to_string(red) + "," + std::to_string(green) + "," + std::to_string(blue) + ",255";
}

/// Returns an expression, escaped for XML, that is true if a height is in a class.
std::string class_filter(std::span<const HeightClass> classes, std::size_t height_class,
                         const std::string& height) {
    std::string text = height_class == 0 ? height + " IS NOT NULL"
                                         : height + " &gt;= " + number_text(classes[height_class].from);
    if (height_class + 1 < classes.size())
        text += " AND " + height + " &lt; " + number_text(classes[height_class + 1].from);
    return text;
}

/// Returns a data-defined property of a symbol.
std::string data_defined_property(const std::string& name, const std::string& expression) {
    return "        <Option type=\"Map\" name=\"" + name +
           "\">\n         <Option type=\"bool\" name=\"active\" value=\"true\"/>\n"
           "         <Option type=\"QString\" name=\"expression\" value=\"" +
           expression +
           "\"/>\n         <Option type=\"int\" name=\"type\" value=\"3\"/>\n        </Option>\n";
}

/// Wraps data-defined properties in their element.
std::string data_defined_property_set(const std::string& element, const std::string& properties) {
    return "     <" + element +
           ">\n      <Option type=\"Map\">\n"
           "       <Option type=\"QString\" name=\"name\" value=\"\"/>\n"
           "       <Option type=\"Map\" name=\"properties\">\n" +
           properties +
           "       </Option>\n       <Option type=\"QString\" name=\"type\" value=\"collection\"/>\n"
           "      </Option>\n     </" +
           element + ">\n";
}

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

/// @param colour "" for no fill @param width of the outline in millimetres; "" for none @param line style of
/// the outline
std::string area(const std::string& colour, const std::string& edge, const std::string& width,
                 const std::string& line = "solid", const std::string& defined = "") {
    return symbol_layer("SimpleFill",
                        {{"color", colour.empty() ? "0,0,0,0" : colour},
                         {"style", colour.empty() ? "no" : "solid"},
                         {"joinstyle", "miter"},
                         {"outline_color", edge},
                         {"outline_style", width.empty() ? "no" : line},
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
/// covers the relief. Hatching and the dashed outline tell it from buildings in print without colours.
std::string hatched() {
    constexpr const char* magenta = "174,1,126,255";
    return area("255,255,255,170", magenta, "") +
           symbol_layer("LinePatternFill", {{"angle", "45"},
                                            {"color", magenta},
                                            {"distance", "1.3"},
                                            {"distance_unit", "MM"},
                                            {"line_width", "0.35"},
                                            {"line_width_unit", "MM"}}) +
           area("", magenta, "0.5", "dash");
}

/// White overlay on uncertain features: the less certain, the whiter. Makes the outline dashed, because pale
/// colours could be those of low buildings in print without colours.
std::string veil(const LayerStyle& style, const std::string& certainty) {
    constexpr UncertaintyOverlay opacity;
    const std::string colour = "color_rgba(255, 255, 255, scale_linear(" + certainty + ", " +
                               number_text(opacity.low) + ", " + number_text(style.certain) + ", " +
                               number_text(opacity.most) + ", " + number_text(opacity.least) + "))";
    return area(
        "255,255,255,130", "255,255,255,255", "0.3", "dash",
        data_defined_property_set("data_defined_properties", data_defined_property("fillColor", colour)));
}

std::string rule(std::size_t number, const std::string& filter, const std::string& label) {
    const std::string text = std::to_string(number);
    return "    <rule key=\"{dem2buildings-" + text + "}\" symbol=\"" + text + "\" filter=\"" + filter +
           "\" label=\"" + writing::xml_text(label) + "\"/>\n";
}

/// Thins outlines on small scales, because dense outlines would cover the colours.
std::string outline_width_by_scale() {
    return data_defined_property_set(
        "data_defined_properties",
        data_defined_property("outlineWidth",
                              "coalesce(scale_linear(@map_scale, 1000, 5000, 0.16, 0.04), 0.12)"));
}

/// Rules below one that is only the heading of the legend.
std::string headed_rules(const std::string& title, const std::string& rules, const std::string& symbols) {
    return "  <rules key=\"{dem2buildings}\">\n   <rule key=\"{dem2buildings-heading}\" label=\"" +
           writing::xml_text(title) + "\">\n" + rules + "   </rule>\n  </rules>\n  <symbols>\n" + symbols +
           "  </symbols>\n";
}

/// One rule per class.
std::string height_rules(const LayerStyle& style, const Columns& columns) {
    const std::size_t classes = columns.classes.size();
    std::string rules;
    std::string symbols;
    for (std::size_t i = 0; i < classes; ++i) {
        rules += rule(i, class_filter(columns.classes, i, columns.colour), class_label(columns.classes, i));
        symbols += symbol(i, area(colour_text(columns.classes[i]), "70,45,35,255", "0.12", "solid",
                                  outline_width_by_scale()));
    }
    if (!columns.certainty.empty()) {
        rules += rule(classes,
                      columns.certainty + " &lt; " + number_text(style.certain) + " AND " + columns.colour +
                          " IS NOT NULL",
                      "paler: less certain");
        symbols += symbol(classes, veil(style, columns.certainty));
    }
    const std::string note = columns.median.empty() ? "" : "; label 12\u201325 m: median to 90th percentile";
    return headed_rules(style.title + note, rules, symbols);
}

/// Eighth of the compass. Its colour is for the legend and for QGIS where it cannot compute a colour.
struct Sector {
    const char* name;
    const char* colour;
};
// North is blue and south orange, against each other on the circle of hues.
constexpr std::array<Sector, 8> sectors{{{"north", "87,130,217,255"},
                                         {"north-east", "87,217,206,255"},
                                         {"east", "87,217,108,255"},
                                         {"south-east", "163,217,87,255"},
                                         {"south", "217,173,87,255"},
                                         {"south-west", "217,87,98,255"},
                                         {"west", "217,87,195,255"},
                                         {"north-west", "141,87,217,255"}}};

/// True in the sector of a number; each extends by 22.5 degrees to both sides of its direction.
std::string sector_filter(std::size_t number, const Columns& columns) {
    constexpr double width = 360.0 / sectors.size();
    const std::string from = number_text(static_cast<double>(number) * width - width / 2);
    const std::string to = number_text(static_cast<double>(number) * width + width / 2);
    if (number == 0)
        return columns.azimuth + " &gt;= " + number_text(360 - width / 2) + " OR " + columns.azimuth +
               " &lt; " + to;
    return columns.azimuth + " &gt;= " + from + " AND " + columns.azimuth + " &lt; " + to;
}

/// One rule per direction of slope, for flat faces, and for those of unknown slope.
std::string roof_rules(const LayerStyle& style, const Columns& columns) {
    constexpr const char* edge = "70,45,35,255";
    // Paler where the slope is gentle.
    const std::string colour = "color_hsv((580 - " + columns.azimuth + ") % 360, scale_linear(" +
                               columns.slope + ", 8, 50, 25, 75), 85)";
    const std::string defined =
        data_defined_property_set("data_defined_properties", data_defined_property("fillColor", colour));
    std::string rules;
    std::string symbols;
    for (std::size_t i = 0; i < sectors.size(); ++i) {
        rules += rule(i, sector_filter(i, columns), sectors[i].name);
        symbols += symbol(i, area(sectors[i].colour, edge, "0.12", "solid", defined));
    }
    rules += rule(sectors.size(), columns.azimuth + " IS NULL AND " + columns.slope + " IS NOT NULL", "flat");
    symbols += symbol(sectors.size(), area("250,245,225,255", edge, "0.12"));
    rules += rule(sectors.size() + 1, columns.slope + " IS NULL", "doubtful");
    symbols += symbol(sectors.size() + 1, area("190,190,190,255", edge, "0.12"));
    return headed_rules(style.title, rules, symbols);
}

/// One rule per class.
std::string class_rules(const LayerStyle& style, const Columns& columns) {
    std::string rules;
    std::string symbols;
    for (std::size_t i = 0; i < style.classes.size(); ++i) {
        const StyleClass& one = style.classes[i];
        rules += rule(i, columns.classified + " = '" + one.value + "'", one.value);
        symbols += symbol(i, area(one.colour, "70,45,35,255", "0.12", outline_width_by_scale()));
    }
    return headed_rules(style.title, rules, symbols);
}

constexpr const char* sun_title = "Suitability for solar panels north of the equator";

/// One rule per suitability for panels. Limits are those of docs/tasks/solar.md, without that of the area.
std::string sun_rules(const Columns& columns) {
    struct Class {
        const char* name;
        const char* colour;
        std::string filter;
    };
    const std::string tilted = columns.slope + " BETWEEN 10 AND 60 AND " + columns.azimuth;
    const std::array<Class, 4> classes{
        {{"flat, or facing south", "253,191,45,255",
          columns.slope + " &lt; 8 OR (" + tilted + " BETWEEN 135 AND 225)"},
         {"facing east or west", "254,228,150,255", tilted + " BETWEEN 90 AND 270"},
         {"less suitable", "150,165,190,255", columns.slope + " IS NOT NULL"},
         {"doubtful", "190,190,190,255", columns.slope + " IS NULL"}}};
    std::string rules;
    std::string symbols;
    std::string others;  // that no class above takes
    for (std::size_t i = 0; i < classes.size(); ++i) {
        const Class& one = classes[i];
        rules += rule(i, "(" + one.filter + ")" + others, one.name);
        symbols += symbol(i, area(one.colour, "70,45,35,255", "0.12"));
        if (i < 2)
            others += " AND NOT coalesce(" + one.filter + ", false)";
    }
    return headed_rules(sun_title, rules, symbols);
}

/// Returns the 2D renderer: coloured by height, or by azimuth and slope, with a legend, or a single symbol.
std::string renderer(const LayerSpec& spec, const Columns& columns) {
    const LayerStyle& style = spec.style;
    const bool ordered = !columns.order.empty();
    const std::string order = ordered ? "1" : "0";
    std::string text =
        " <renderer-v2 forceraster=\"0\" symbollevels=\"0\" enableorderby=\"" + order + "\" type=\"";
    if (spec.points)
        text += "singleSymbol\">\n  <symbols>\n" + symbol(0, dot(), "marker") + "  </symbols>\n";
    else if (!columns.azimuth.empty())
        text += "RuleRenderer\">\n" + (columns.by_sun ? sun_rules(columns) : roof_rules(style, columns));
    else if (!columns.classified.empty())
        text += "RuleRenderer\">\n" + class_rules(style, columns);
    else if (columns.colour.empty())
        text += "singleSymbol\">\n  <symbols>\n" + symbol(0, hatched()) + "  </symbols>\n";
    else
        text += "RuleRenderer\">\n" + height_rules(style, columns);
    if (ordered)
        text += "  <orderby>\n   <orderByClause asc=\"1\" nullsFirst=\"1\">" + columns.order +
                "</orderByClause>\n  </orderby>\n";
    return text + " </renderer-v2>\n";
}

/// Expression for a height with one decimal below 10 m and in whole metres from there on. Cuts decimals off
/// where rounding would lift the height into the next class, so that label and colour agree: 14.7 m does not
/// become 15.
std::string height_text(const std::string& height) {
    std::string bounds;
    for (const HeightClass& one : height_classes().subspan(1))
        bounds += (bounds.empty() ? "" : ", ") + number_text(one.from);
    const auto shortened = [&](const std::string& places, const std::string& factor) {
        const std::string rounded = "round(" + height + ", " + places + ")";
        return "CASE WHEN " + height + " &lt; " + rounded + " AND " + rounded + " IN (" + bounds +
               ") THEN floor(" + height + " * " + factor + ") / " + factor + " ELSE " + rounded + " END";
    };
    return "CASE WHEN " + height + " &lt; 10 THEN format_number(" + shortened("1", "10") + ", 1) ELSE " +
           shortened("0", "1") + " END";
}

/// True if the roofs of a building lie at several heights, as has_several_roofs().
std::string several_roofs(const Columns& columns) {
    return columns.label + " - " + columns.median + " &gt; " + number_text(one_roof_m);
}

/// Expression for the label of a height, or for the range from the median to the 90th percentile.
std::string height_label(const Columns& columns) {
    const std::string number = height_text(columns.label);
    if (columns.median.empty())
        return number + " || ' m'";
    return "CASE WHEN " + several_roofs(columns) + " THEN " + height_text(columns.median) +
           " || '&#8211;' ELSE '' END || " + number + " || ' m'";
}

/// Returns the labels for large map scales.
std::string labeling(const LayerSpec& spec, const Columns& columns) {
    const auto field = std::ranges::find(spec.fields, spec.style.label, &FieldSpec::name);
    const bool text = field->type == FieldType::text;
    const bool degrees = !columns.slope.empty() && columns.label == columns.slope;
    std::string expression = text      ? columns.label
                             : degrees ? "round(" + columns.label + ") || '&#176;'"
                                       : height_label(columns);
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

std::string scaled(const std::string& expression, double scale) {
    return scale == 1 ? expression : expression + " * " + number_text(scale);
}

std::string material(const HeightClass& height_class) {
    const auto& colour = height_class.colour;
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
std::string solid(const HeightClass& height_class, const std::string& altitude,
                  const std::string& extrusion) {
    return "    <symbol type=\"polygon\" material_type=\"phong\">\n"
           "     <data alt-clamping=\"absolute\" alt-binding=\"centroid\" height=\"0\" offset=\"0\" "
           "extrusion-height=\"0\" culling-mode=\"no-culling\" invert-normals=\"0\" add-back-faces=\"0\" "
           "rendered-facade=\"3\"/>\n" +
           material(height_class) +
           data_defined_property_set("data-defined-properties",
                                     data_defined_property("height", altitude) +
                                         data_defined_property("extrusionHeight", extrusion)) +
           "     <edges enabled=\"0\" width=\"1\" color=\"70,45,35,255\"/>\n    </symbol>\n";
}

/// Returns solids in the colours of the 2D renderer. They stand at their elevations, independent of the
/// terrain of the scene.
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
    for (std::size_t i = 0; i < columns.classes.size(); ++i)
        text += "   <rule key=\"{dem2buildings-" + std::to_string(i) + "}\" description=\"" +
                class_label(columns.classes, i) + "\" filter=\"" +
                class_filter(columns.classes, i, columns.height) + "\">\n" +
                solid(columns.classes[i], altitude, extrusion) + "   </rule>\n";
    return text + "  </rules>\n </renderer-3d>\n";
}

/// Returns a field as a quoted name in an expression.
std::string column(const LayerSpec& spec, const std::vector<std::string>& columns, const std::string& name) {
    const auto field = std::ranges::find(spec.fields, name, &FieldSpec::name);
    if (name.empty() || field == spec.fields.end())
        return "";
    std::string quoted = "\"";
    for (const char letter : columns[static_cast<std::size_t>(field - spec.fields.begin())])
        quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
    return writing::xml_text(quoted + "\"");
}

/// Returns the aliases of fields, with their units.
std::string aliases(const LayerSpec& spec, const std::vector<std::string>& columns) {
    std::string text = " <aliases>\n";
    for (std::size_t i = 0; i < spec.fields.size(); ++i)
        text += "  <alias field=\"" + writing::xml_text(columns[i]) + "\" index=\"" + std::to_string(i) +
                "\" name=\"" + writing::xml_text(spec.fields[i].alias) + "\"/>\n";
    return text + " </aliases>\n";
}

/// Returns the tooltip of a feature in QGIS.
std::string map_tip(const Columns& columns) {
    if (columns.height.empty())
        return "";
    const std::string range = columns.median.empty()
                                  ? ""
                                  : "[% CASE WHEN " + several_roofs(columns) + " THEN round(" +
                                        columns.median + ", 1) || '&#8211;' ELSE '' END %]";
    return " <mapTip>" + range + "[% round(" + columns.height + ", 1) %] m</mapTip>\n";
}

/// Returns the field of the median height in a layer of buildings, which has a prefix if given footprints
/// have a field of its name; "" in other layers.
std::string median_field(const LayerSpec& spec) {
    const auto field = std::ranges::find_if(
        spec.fields, [](const FieldSpec& one) { return one.name == "p50" || one.name.ends_with("d2b_p50"); });
    return field == spec.fields.end() || spec.style.colour.empty() ? "" : field->name;
}

/// @param by_sun see Columns
std::string document(const LayerSpec& spec, const std::vector<std::string>& columns, bool by_sun,
                     std::span<const HeightClass> classes) {
    const LayerStyle& style = spec.style;
    const auto named = [&](const std::string& name) { return column(spec, columns, name); };
    const Columns fields{.colour = named(style.colour),
                         .label = named(style.label),
                         .median = named(median_field(spec)),
                         .labelled = {named(style.labelled[0]), named(style.labelled[1])},
                         .order = named(style.order),
                         .certainty = named(style.certainty),
                         .slope = named(style.slope),
                         .azimuth = named(style.azimuth),
                         .classified = named(style.classified),
                         .top = named(style.top),
                         .bottom = named(style.bottom),
                         .height = named(style.height),
                         .min_height = named(style.min_height),
                         .by_sun = by_sun,
                         .classes = classes};
    std::string text = "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n";
    text += writing::style_signature;
    text += "<qgis version=\"3.16.0\" labelsEnabled=\"" +
            std::string(fields.label.empty() || !style.labels_on ? "0" : "1") +
            "\" hasScaleBasedVisibilityFlag=\"0\">\n";
    if (!(fields.top + fields.bottom).empty() && !fields.height.empty())
        text += renderer_3d(spec, fields);
    text += renderer(spec, fields);
    if (!fields.label.empty())
        text += labeling(spec, fields);
    text += aliases(spec, columns) + map_tip(fields);
    return text + " <layerGeometryType>" + (spec.points ? "0" : "2") + "</layerGeometryType>\n</qgis>\n";
}

}  // namespace
}  // namespace d2b::qml

namespace d2b::writing {

std::string qml_style(const LayerSpec& spec, const std::vector<std::string>& columns) {
    return qml::document(spec, columns, false, height_classes());
}

std::vector<NamedStyle> qml_styles(const NewLayer& layer) {
    const LayerSpec& spec = layer.spec;
    std::vector<NamedStyle> styles{
        {std::string(default_style_name), spec.style.title, qml_style(spec, layer.columns)}};
    if (!spec.style.azimuth.empty())
        styles.push_back({std::string(sun_style_name), qml::sun_title,
                          qml::document(spec, layer.columns, true, height_classes())});
    if (const std::vector<HeightClass> classes = quantile_classes(layer.heights); !classes.empty())
        styles.push_back({std::string(quantile_style_name), spec.style.title + ", equal numbers",
                          qml::document(spec, layer.columns, false, classes)});
    return styles;
}

namespace {

/// Turns "D2B_NOISE_FACTOR" into "noise factor".
std::string readable_key(std::string name) {
    if (name.starts_with("D2B_"))
        name.erase(0, 4);
    for (char& letter : name)
        letter = letter == '_'                    ? ' '
                 : letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter + 32)
                                                  : letter;
    return name;
}

std::string abstract(const LayerSpec& spec) {
    std::string text = spec.description;
    for (const FieldSpec& field : spec.fields)
        text += "\n" + field.name + (field.unit.empty() ? "" : " [" + field.unit + "]") + ": " +
                field.description;
    return text;
}

}  // namespace

std::string qgis_metadata(const LayerSpec& spec, const Provenance& provenance) {
    std::string text =
        "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n<qgis version=\"3.16.0\">\n";
    text += xml_element(1, "identifier", spec.name) + xml_element(1, "language", "ENG") +
            xml_element(1, "type", "dataset") + xml_element(1, "title", spec.title) +
            xml_element(1, "abstract", abstract(spec));
    for (const auto& [name, value] : provenance.metadata)
        if (!value.empty())
            text += xml_element(1, "history", readable_key(name) + ": " + value);
    return text + "</qgis>\n";
}

namespace fs = std::filesystem;

void write_style_sidecar(const std::string& path, const NewLayer& layer) {
    if (layer.spec.style.title.empty())
        return;
    const bool single = fs::path(path).extension() == ".shp";
    VSIStatBufL status{};
    if (!single && (VSIStatL(path.c_str(), &status) != 0 || !VSI_ISDIR(status.st_mode)))
        return;  // because QGIS looks for no style of a packed Shapefile (.shz, .shp.zip)
    const fs::path file =
        single ? fs::path(path).replace_extension(".qml") : fs::path(path) / (layer.table + ".qml");
    const std::string text = qml_style(layer.spec, layer.columns);
    // Failed writes are detected by the VSI layer that monitors the files.
    const reading::GdalMessages quiet;
    VSILFILE* out = VSIFOpenL(file.string().c_str(), "wb");
    if (out == nullptr)
        return;
    const bool whole = VSIFWriteL(text.data(), 1, text.size(), out) == text.size();
    if (VSIFCloseL(out) != 0 || !whole)
        VSIUnlink(file.string().c_str());
}

bool is_our_style(const fs::path& file) {
    constexpr int lines = 3;
    std::ifstream in(file);
    std::string line;
    for (int i = 0; i < lines && std::getline(in, line); ++i)
        if (line + "\n" == style_signature)
            return true;
    return false;
}

void keep_user_styles(const fs::path& result, const fs::path& destination, bool replaces) {
    std::error_code error;
    const bool folder = fs::is_directory(result, error);
    const fs::path ours = folder ? result : result.parent_path();
    const fs::path theirs = folder ? destination : destination.parent_path();
    std::vector<fs::path> styles;
    for (const auto& entry : fs::directory_iterator(ours, error))
        if (entry.path().extension() == ".qml")
            styles.push_back(entry.path());
    for (const fs::path& style : styles) {
        const fs::path there = theirs / style.filename();
        if (!fs::exists(there, error) || (replaces && is_our_style(there)))
            continue;
        if (folder)
            fs::copy_file(there, style, fs::copy_options::overwrite_existing, error);
        else
            fs::remove(style, error);
    }
}

}  // namespace d2b::writing

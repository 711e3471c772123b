#include "write/layer_metadata.hpp"

#include "write/xml_text.hpp"

namespace d2b {

namespace {

std::string element(const std::string& name, const std::string& text) {
    return " <" + name + ">" + xml_text(text) + "</" + name + ">\n";
}

/// Turns "D2B_NOISE_FACTOR" into "noise factor".
std::string words(std::string name) {
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
    text += element("identifier", spec.name) + element("language", "ENG") + element("type", "dataset") +
            element("title", spec.title) + element("abstract", abstract(spec));
    for (const auto& [name, value] : provenance.metadata)
        if (!value.empty())
            text += element("history", words(name) + ": " + value);
    return text + "</qgis>\n";
}

}  // namespace d2b

#include "write/layer_choice.hpp"

#include "core/utf8_text.hpp"
#include "dem2buildings/error.hpp"
#include "write/laundered_name.hpp"

namespace d2b {

namespace {

std::string stem_of(const std::string& destination) {
    const std::string file = destination.substr(destination.find_last_of('/') + 1);
    return file.substr(0, file.find_last_of('.'));
}

std::string suffix_of(LayerRole role, Layers layers) {
    switch (role) {
        case LayerRole::doubtful:
            return "_doubtful";
        case LayerRole::rejected:
            return "_rejected";
        case LayerRole::problems:
            return "_problems";
        case LayerRole::contours:
            return layers == Layers::both ? "_contours" : "";
        case LayerRole::buildings:
            break;
    }
    return "";
}

}  // namespace

Layers resolve_layers(const WriteOptions& options, const VectorFormat& format) {
    if ((options.doubtful || options.rejected) && !format.several_layers)
        throw OptionError("\"" + options.destination + "\" holds one layer (format " + format.name +
                          "); use a GeoPackage for -write_" + (options.doubtful ? "doubtful." : "rejected."));
    if (!options.layers)
        return format.several_layers ? Layers::both : Layers::buildings;
    if (options.layers == Layers::both && !format.several_layers)
        throw OptionError("\"" + options.destination + "\" holds one layer (format " + format.name +
                          "); use -layers buildings or -layers contours, or a GeoPackage for both.");
    return *options.layers;
}

std::string name_of(const WriteOptions& options, const VectorFormat& format, LayerRole role, Layers layers) {
    if (!options.layer_name.empty())
        return laundered_name(utf8_text(options.layer_name), suffix_of(role, layers), format, options);
    const bool file_is_layer = !format.several_layers && !is_stream(options.destination) &&
                               !is_connection(format.driver, options.destination);
    std::string stem = utf8_text(stem_of(options.destination));
    if (file_is_layer && !stem.empty())
        return stem;
    switch (role) {
        case LayerRole::buildings:
            return "buildings";
        case LayerRole::contours:
            return "contours";
        case LayerRole::doubtful:
            return "doubtful";
        case LayerRole::rejected:
            return "rejected";
        case LayerRole::problems:
            break;
    }
    return "problems";
}

std::vector<std::string> names_of(const WriteOptions& options, const VectorFormat& format, Layers layers) {
    std::vector<std::string> names;
    if (layers != Layers::contours)
        names.push_back(name_of(options, format, LayerRole::buildings, layers));
    if (layers != Layers::buildings)
        names.push_back(name_of(options, format, LayerRole::contours, layers));
    if (options.doubtful)
        names.push_back(name_of(options, format, LayerRole::doubtful, layers));
    if (options.rejected)
        names.push_back(name_of(options, format, LayerRole::rejected, layers));
    if (options.problems && format.several_layers)
        names.push_back(name_of(options, format, LayerRole::problems, layers));
    return names;
}

}  // namespace d2b

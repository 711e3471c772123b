#include "write/vector/layer_names.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal_version.h>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "write/ogr_util.hpp"
#include "write/vector/dxf_sink.hpp"

namespace d2b::writing {

namespace {

/// Returns the longest name of a table. PostgreSQL truncates names after 63 bytes, and the driver names the
/// primary key like the table plus "_pk", which must not be truncated to the name of the table. Since 3.10 it
/// shortens the name of the spatial index, the table's plus "_geom_geom_idx", by bytes, which may split a
/// character.
std::size_t max_bytes(const std::string& name) {
    const bool is_ascii = std::ranges::all_of(name, [](unsigned char letter) { return letter < 0x80U; });
    return is_ascii ? 60 : 49;
}

/// Returns eight hexadecimal digits that differ if the names differ.
std::string hash_digits(const std::string& name) {
    std::uint32_t hash = 2166136261U;  // FNV-1a
    for (const char letter : name)
        hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619U;
    std::string digits;
    for (int shift = 28; shift >= 0; shift -= 4)
        digits += "0123456789abcdef"[(hash >> shift) & 15U];
    return digits;
}

/// Truncates UTF-8 text without splitting a character.
std::string truncate_utf8(const std::string& text, std::size_t bytes) {
    std::size_t end = std::min(bytes, text.size());
    while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
        --end;
    return text.substr(0, end);
}

bool option_is_on(const NameValueList& options, const char* key, bool standard) {
    const char* value = options.get() == nullptr ? nullptr : CSLFetchNameValue(options.get(), key);
    return value == nullptr ? standard : CPLTestBool(value);
}

/// True if no driver changes the name.
bool is_plain(const std::string& name) {
    constexpr std::size_t shortest_limit = 50;
    return name.size() <= shortest_limit && std::ranges::all_of(name, [](unsigned char letter) {
               return std::islower(letter) != 0 || std::isdigit(letter) != 0 || letter == '_';
           });
}

/// Launders like GDAL does for PostgreSQL: lower case, without apostrophes, hyphens and number signs. Also
/// replaces parentheses, because GDAL takes their contents for a geometry column when it looks up a layer.
std::string launder_for_postgresql(const std::string& base, const std::string& suffix,
                                   const NameValueList& options) {
    std::string name = base;
#if GDAL_VERSION_NUM >= GDAL_COMPUTE_VERSION(3, 9, 0)
    const bool is_ascii = option_is_on(options, "LAUNDER_ASCII", false);
    if (is_ascii) {
        char* ascii = CPLUTF8ForceToASCII(name.c_str(), '_');
        name = ascii;
        CPLFree(ascii);
    }
#else
    const bool is_ascii = false;
#endif
    if (is_ascii || option_is_on(options, "LAUNDER", true))
        for (char& letter : name) {
            if (static_cast<unsigned char>(letter) < 0x80U)
                letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
            if (std::string_view("'-#()").find(letter) != std::string_view::npos)
                letter = '_';
        }
    const std::size_t longest = max_bytes(name);
    if (name.size() + suffix.size() <= longest)
        return name + suffix;
    const std::string digits = "_" + hash_digits(base);
    return truncate_utf8(name, longest - suffix.size() - digits.size()) + digits + suffix;
}

/// Creates the layer in memory and returns its name.
std::string created_layer_name(const std::string& name, const VectorFormat& format,
                               const WriteOptions& options) {
    const reading::GdalMessages quiet;
    const VsimemFolder memory;
    const reading::DatasetOwner dataset =
        create_trial(format.driver, memory.file(probe_name(format.driver, options.destination)));
    const NameValueList chosen(options.layer_options);
    OGRLayerH layer = dataset ? GDALDatasetCreateLayer(dataset.get(), name.c_str(), nullptr, wkbMultiPolygon,
                                                       const_cast<char**>(chosen.get()))
                              : nullptr;
    const char* called = layer == nullptr ? nullptr : OGR_L_GetName(layer);
    return called == nullptr || *called == '\0' ? name : called;
}

/// Returns the name that a driver will give to a layer. Existing layers are looked up by it, because drivers
/// of databases replace some characters, and PostgreSQL truncates long names. @param base of the layer name
/// @param suffix of its role, for example "_contours"; kept if the base is shortened
std::string laundered_name(const std::string& base, const std::string& suffix, const VectorFormat& format,
                           const WriteOptions& options) {
    if (format.name == "PostgreSQL")
        return launder_for_postgresql(base, suffix, NameValueList(options.layer_options));
    std::string name = base + suffix;
    if (is_drawing(format))
        return drawing_layer_name(name);
    // Other drivers are tried, because their rules are not known; names in a GeoPackage do not change.
    const bool is_geopackage = format.name == "GPKG" && !NameValueList(options.layer_options).has("LAUNDER");
    if (is_plain(name) || is_geopackage || !format.multiple_layers ||
        !has_capability(format.driver, GDAL_DCAP_VIRTUALIO))
        return name;
    return created_layer_name(name, format, options);
}

std::string stem_of(const std::string& destination) {
    const std::string file = destination.substr(destination.find_last_of('/') + 1);
    return file.substr(0, file.find_last_of('.'));
}

/// Returns the end of a layer's name after -nln.
std::string suffix_of(LayerRole role, Layers layers) {
    const bool has_own_name =
        role == LayerRole::buildings || (role == LayerRole::contours && layers != Layers::both);
    return has_own_name ? "" : "_" + default_layer_name(role);
}

}  // namespace

Layers resolve_layers(const WriteOptions& options, std::optional<Layers> asked, const VectorFormat& format) {
    if ((options.doubtful || options.rejected || options.roofs) && !format.multiple_layers)
        throw OptionError("\"" + options.destination + "\" holds one layer (format " + format.name +
                          "); use a GeoPackage for -" +
                          (options.doubtful   ? "write_doubtful."
                           : options.rejected ? "write_rejected."
                                              : "roofs."));
    if (!asked)
        return format.multiple_layers ? Layers::both : Layers::buildings;
    if (asked == Layers::both && !format.multiple_layers)
        throw OptionError("\"" + options.destination + "\" holds one layer (format " + format.name +
                          "); use -layers buildings or -layers contours, or a GeoPackage for both.");
    return *asked;
}

std::string name_of(const WriteOptions& options, const VectorFormat& format, LayerRole role, Layers layers) {
    if (!options.layer_name.empty())
        return laundered_name(utf8_text(options.layer_name), suffix_of(role, layers), format, options);
    const bool file_is_layer = !format.multiple_layers && !is_stream(options.destination) &&
                               !is_connection(format.driver, options.destination);
    const std::string stem = file_is_layer ? utf8_text(stem_of(options.destination)) : "";
    return stem.empty() ? default_layer_name(role) : stem;
}

std::vector<std::string> names_of(const WriteOptions& options, const VectorFormat& format, Layers layers) {
    std::vector<std::string> names;
    const auto add = [&](LayerRole role, bool is_written) {
        if (is_written)
            names.push_back(name_of(options, format, role, layers));
    };
    add(LayerRole::buildings, layers != Layers::contours);
    add(LayerRole::contours, layers != Layers::buildings);
    add(LayerRole::missing, options.has_footprints() && format.multiple_layers);
    add(LayerRole::roofs, options.roofs);
    add(LayerRole::doubtful, options.doubtful);
    add(LayerRole::rejected, options.rejected);
    add(LayerRole::problems, options.problems && format.multiple_layers);
    return names;
}

}  // namespace d2b::writing

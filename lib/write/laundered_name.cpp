#include "write/laundered_name.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal_version.h>

#include "read/gdal_messages.hpp"
#include "write/ogr_handles.hpp"
#include "write/trial_dataset.hpp"

namespace d2b {

namespace {

/// PostgreSQL truncates names after 63 bytes, and the driver names the primary key like the table plus "_pk",
/// which must not be truncated to the name of the table.
constexpr std::size_t most_bytes = 60;

/// Returns eight hexadecimal digits that differ if the names differ.
std::string digits_of(const std::string& name) {
    std::uint32_t hash = 2166136261U;  // FNV-1a
    for (const char letter : name)
        hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619U;
    std::string digits;
    for (int shift = 28; shift >= 0; shift -= 4)
        digits += "0123456789abcdef"[(hash >> shift) & 15U];
    return digits;
}

/// Truncates UTF-8 text without splitting a character.
std::string first_bytes(const std::string& text, std::size_t bytes) {
    std::size_t end = std::min(bytes, text.size());
    while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
        --end;
    return text.substr(0, end);
}

bool is_on(const NameValueList& options, const char* key, bool standard) {
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
std::string in_postgresql(const std::string& base, const std::string& suffix, const NameValueList& options) {
    std::string name = base;
#if GDAL_VERSION_NUM >= GDAL_COMPUTE_VERSION(3, 9, 0)
    const bool is_ascii = is_on(options, "LAUNDER_ASCII", false);
    if (is_ascii) {
        char* ascii = CPLUTF8ForceToASCII(name.c_str(), '_');
        name = ascii;
        CPLFree(ascii);
    }
#else
    const bool is_ascii = false;
#endif
    if (is_ascii || is_on(options, "LAUNDER", true))
        for (char& letter : name) {
            if (static_cast<unsigned char>(letter) < 0x80U)
                letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
            if (std::string_view("'-#()").find(letter) != std::string_view::npos)
                letter = '_';
        }
    if (name.size() + suffix.size() <= most_bytes)
        return name + suffix;
    const std::string digits = "_" + digits_of(base);
    return first_bytes(name, most_bytes - suffix.size() - digits.size()) + digits + suffix;
}

/// Creates the layer in memory and returns its name.
std::string as_tried(const std::string& name, const VectorFormat& format, const WriteOptions& options) {
    const GdalMessages quiet;
    const MemoryFolder memory;
    const std::string file = memory.file(trial_name(format.driver, options.destination));
    const DatasetOwner dataset(GDALCreate(format.driver, file.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    const NameValueList chosen(options.layer_options);
    OGRLayerH layer = dataset ? GDALDatasetCreateLayer(dataset.get(), name.c_str(), nullptr, wkbMultiPolygon,
                                                       const_cast<char**>(chosen.get()))
                              : nullptr;
    const char* called = layer == nullptr ? nullptr : OGR_L_GetName(layer);
    return called == nullptr || *called == '\0' ? name : called;
}

}  // namespace

std::string laundered_name(const std::string& base, const std::string& suffix, const VectorFormat& format,
                           const WriteOptions& options) {
    if (format.name == "PostgreSQL")
        return in_postgresql(base, suffix, NameValueList(options.layer_options));
    std::string name = base + suffix;
    // Other drivers are tried, because their rules are not known; names in a GeoPackage do not change.
    const bool is_geopackage = format.name == "GPKG" && !NameValueList(options.layer_options).has("LAUNDER");
    if (is_plain(name) || is_geopackage || !format.several_layers || !keeps_virtual_files(format.driver))
        return name;
    return as_tried(name, format, options);
}

}  // namespace d2b

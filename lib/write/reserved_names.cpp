#include "write/reserved_names.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <cpl_string.h>

#include "dem2buildings/error.hpp"

namespace d2b {

namespace {

constexpr std::array beginnings{"sqlite_", "gpkg_", "rtree_"};
constexpr std::array reserved_tables{"layer_styles",    "qgis_projects",       "geometry_columns",
                                     "spatial_ref_sys", "spatial_ref_sys_aux", "views_geometry_columns",
                                     "ogr_empty_table", "spatialite_history",  "vector_layers"};

bool is_reserved(const std::string& name) {
    const auto begins = [&](const char* beginning) {
        return EQUALN(name.c_str(), beginning, std::string_view(beginning).size());
    };
    return std::ranges::any_of(beginnings, begins) ||
           std::ranges::any_of(reserved_tables,
                               [&](const char* table) { return EQUAL(name.c_str(), table); });
}

/// True if a column would duplicate a field. FID may be an integer field, which then holds the feature ids as
/// well.
bool clashes(const FieldSpec& field, const std::string& column, bool fid) {
    return EQUAL(field.name.c_str(), column.c_str()) && !(fid && field.type == FieldType::integer);
}

void refuse_column(const std::string& option, std::span<const LayerSpec> layers) {
    const auto equals = option.find('=');
    const std::string name = option.substr(0, equals);
    const bool fid = EQUAL(name.c_str(), "FID");
    if (equals == std::string::npos || (!fid && !EQUAL(name.c_str(), "GEOMETRY_NAME")))
        return;
    const std::string column = option.substr(equals + 1);
    for (const LayerSpec& layer : layers)
        for (const FieldSpec& field : layer.fields)
            if (clashes(field, column, fid))
                throw OptionError("-lco " + option + " is the name of a field of the layer \"" + layer.name +
                                  "\"; choose another name.");
}

}  // namespace

void refuse_reserved_names(const VectorFormat& format, const WriteOptions& options,
                           std::span<const LayerSpec> layers) {
    if (format.name != "GPKG" && format.name != "SQLite")
        return;
    for (const LayerSpec& layer : layers)
        if (is_reserved(layer.name))
            throw OptionError("-nln: a table \"" + layer.name + "\" of a " + format.name +
                              " file has a meaning of its own; choose another name.");
    for (const std::string& option : options.layer_options)
        refuse_column(option, layers);
}

}  // namespace d2b

#include "read/polygon_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include "core/number_from_chars.hpp"
#include "dem2buildings/error.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_handles.hpp"
#include "read/gdal_messages.hpp"
#include "read/polygon_geometry.hpp"
#include "read/raster_crs.hpp"
#include "read/vector_dataset.hpp"

namespace d2b {
namespace {

std::string field_list(OGRFeatureDefnH schema) {
    const int count = OGR_FD_GetFieldCount(schema);
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        names.emplace_back(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(schema, i)));
    return quoted_names(names);
}

/// Returns the index of the height field, or -1.
int pick_height(OGRLayerH layer, const LayerChoice& choice) {
    const OGRFeatureDefnH schema = OGR_L_GetLayerDefn(layer);
    if (choice.height_field.empty()) {
        for (const std::string& name : choice.default_heights)
            if (const int field = OGR_FD_GetFieldIndex(schema, name.c_str()); field >= 0)
                return field;
        return -1;
    }
    const int field = OGR_FD_GetFieldIndex(schema, choice.height_field.c_str());
    if (field >= 0)
        return field;
    const std::string names = field_list(schema);
    throw OptionError("The layer '" + std::string(OGR_L_GetName(layer)) + "' of '" + choice.dataset +
                      "' has no field '" + choice.height_field + "'; " +
                      (names.empty() ? "it has no fields at all." : "its fields are " + names + "."));
}

/// Returns the height of a feature. Texts count if they are numbers throughout, because heights of
/// OpenStreetMap are stored as texts.
std::optional<double> height_of(OGRFeatureH feature, int field) {
    if (field < 0 || OGR_F_IsFieldSetAndNotNull(feature, field) == FALSE)
        return std::nullopt;
    double value = 0;
    const OGRFieldType type = OGR_Fld_GetType(OGR_F_GetFieldDefnRef(feature, field));
    if (type == OFTInteger || type == OFTInteger64 || type == OFTReal) {
        value = OGR_F_GetFieldAsDouble(feature, field);
    } else {
        const std::string text = OGR_F_GetFieldAsString(feature, field);
        const char* const end = text.data() + text.size();
        const auto [stop, error] = number_from_chars(text.data(), end, value);
        if (error != std::errc() || stop != end)
            return std::nullopt;
    }
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

void warn_of_others(std::size_t others, const PolygonLayer& layer, Warnings& warnings) {
    if (others > 0)
        warnings.add(std::to_string(others) + (others == 1 ? " feature" : " features") + " of the layer '" +
                     layer.name + "' of '" + layer.dataset + "' " + (others == 1 ? "has" : "have") +
                     " no polygon and " + (others == 1 ? "is" : "are") + " left out.");
}

DatasetOwner open_polygons(const std::string& path, Warnings& warnings) {
    return open_vector_dataset(path, "'" + path + "' cannot be opened as a vector dataset", warnings);
}

}  // namespace

std::vector<std::string> layer_names(const std::string& dataset, Warnings& warnings) {
    const FetchGate gate(dataset);
    return geometry_layers(open_polygons(dataset, warnings).get());
}

PolygonLayer read_polygon_layer(const LayerChoice& choice, Warnings& warnings) {
    const FetchGate gate(choice.dataset);
    const DatasetOwner dataset = open_polygons(choice.dataset, warnings);
    const OGRLayerH layer = pick_layer(dataset.get(), choice);
    const int height = pick_height(layer, choice);
    PolygonLayer result{choice.dataset, OGR_L_GetName(layer), wkt_of(OGR_L_GetSpatialRef(layer)), {}, {}};
    if (height >= 0)
        result.height_field = OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(OGR_L_GetLayerDefn(layer), height));
    std::size_t others = 0;
    for_each_geometry(layer, "The layer '" + result.name + "' of '" + choice.dataset + "'", warnings,
                      [&](OGRFeatureH feature, OGRGeometryH geometry) {
                          PolygonFeature found = polygon_feature_of(geometry);
                          found.height = height_of(feature, height);
                          if (found.polygons.empty())
                              ++others;
                          else
                              result.features.push_back(std::move(found));
                      });
    warn_of_others(others, result, warnings);
    return result;
}

}  // namespace d2b

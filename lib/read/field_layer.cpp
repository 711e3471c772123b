#include "read/field_layer.hpp"

#include <cstddef>
#include <utility>

#include "dem2buildings/error.hpp"
#include "read/fetch_gate.hpp"
#include "read/georeferencing.hpp"
#include "read/vector_layer.hpp"

namespace d2b::reading {
namespace {

/// Returns the index of a field in the schema; -1 if the layer does not have it.
int index_of(OGRLayerH layer, const std::string& dataset, const WantedField& wanted) {
    const OGRFeatureDefnH schema = OGR_L_GetLayerDefn(layer);
    for (const std::string& name : wanted.names)
        if (const int field = OGR_FD_GetFieldIndex(schema, name.c_str()); field >= 0)
            return field;
    if (wanted.required)
        refuse_missing_field(layer, dataset, wanted.names.front());
    return -1;
}

std::optional<std::string> value_of(OGRFeatureH feature, int field) {
    if (field < 0 || OGR_F_IsFieldSetAndNotNull(feature, field) == FALSE)
        return std::nullopt;
    return OGR_F_GetFieldAsString(feature, field);
}

}  // namespace

FieldLayer read_field_layer(const LayerChoice& choice, std::span<const WantedField> wanted,
                            Warnings& warnings) {
    const NetworkGuard gate(choice.dataset);
    const DatasetOwner dataset = open_polygons(choice.dataset, warnings);
    const OGRLayerH layer = pick_layer(dataset.get(), choice);
    FieldLayer result{choice.dataset, OGR_L_GetName(layer), wkt_of(OGR_L_GetSpatialRef(layer)), {}, true, {}};
    std::vector<int> fields;
    for (const WantedField& field : wanted) {
        fields.push_back(index_of(layer, choice.dataset, field));
        result.has.push_back(fields.back() >= 0);
    }
    for_each_polygon_feature(layer, choice.dataset, warnings,
                             [&](OGRFeatureH feature, OGRGeometryH geometry) {
                                 FieldFeature found;
                                 found.shape = polygon_feature_of(geometry, &found.elevations);
                                 if (found.shape.polygons.empty())
                                     return false;
                                 result.elevations = result.elevations && OGR_G_Is3D(geometry) != FALSE;
                                 for (const int field : fields)
                                     found.values.push_back(value_of(feature, field));
                                 result.features.push_back(std::move(found));
                                 return true;
                             });
    return result;
}

}  // namespace d2b::reading

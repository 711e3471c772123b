#include "write/layer_fit.hpp"

#include <array>

#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "read/raster_crs.hpp"

namespace d2b {

namespace {

std::string srs_name(OGRSpatialReferenceH srs) {
    const char* name = srs == nullptr ? nullptr : OSRGetName(srs);
    return name == nullptr ? "no CRS" : "\"" + std::string(name) + "\"";
}

bool same_srs(OGRSpatialReferenceH a, OGRSpatialReferenceH b) {
    const bool has_a = !wkt_of(a).empty();
    const bool has_b = !wkt_of(b).empty();
    if (!has_a || !has_b)
        return has_a == has_b;
    const std::array<const char*, 3> options{"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
                                             "CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS", nullptr};
    return OSRIsSameEx(a, b, options.data()) != FALSE;
}

/// Accepts text for any type, because formats without a schema (CSV, GeoJSON) report text if they cannot
/// infer a type.
bool type_fits(FieldType wanted, OGRFieldType there) {
    switch (wanted) {
        case FieldType::integer:
            return there == OFTInteger64 || there == OFTInteger || there == OFTReal || there == OFTString;
        case FieldType::real:
            return there == OFTReal || there == OFTString;
        case FieldType::text:
            break;
    }
    return there == OFTString;
}

/// Returns the mismatch; "" if there is none.
std::string geometry_misfit(OGRLayerH layer, const LayerSpec& spec) {
    const OGRwkbGeometryType type = OGR_L_GetGeomType(layer);
    const OGRwkbGeometryType flat = wkbFlatten(type);
    if (flat == wkbUnknown || flat == wkbNone)
        return "";
    const bool fits = spec.points ? flat == wkbPoint
                                  : flat == wkbMultiPolygon || flat == wkbPolygon || flat == wkbMultiSurface;
    if (!fits)
        return "holds geometries of type " + std::string(OGRGeometryTypeToName(type)) + " and not " +
               (spec.points ? "points" : "MultiPolygons");
    if ((OGR_GT_HasZ(type) != FALSE) != spec.with_z)
        return spec.with_z ? "has no Z, and the result has" : "has Z, and the result has none";
    return "";
}

}  // namespace

std::vector<int> fitting_fields(OGRLayerH layer, const LayerSpec& spec, const LayerSetting& setting) {
    const auto misfit = [&](const std::string& what) {
        return OutputError("Cannot append to \"" + setting.target.name + "\": its layer \"" +
                           OGR_L_GetName(layer) + "\" " + what + "; write to another destination.");
    };
    OGRSpatialReferenceH there = OGR_L_GetSpatialRef(layer);
    if (setting.format.keeps_crs && !same_srs(there, setting.srs))
        throw misfit("is in " + srs_name(there) + " and the result in " + srs_name(setting.srs));
    const std::string geometry = geometry_misfit(layer, spec);
    if (!geometry.empty())
        throw misfit(geometry);
    std::vector<int> indices;
    OGRFeatureDefnH fields = OGR_L_GetLayerDefn(layer);
    for (const FieldSpec& field : spec.fields) {
        const int index = OGR_FD_GetFieldIndex(fields, field.name.c_str());
        if (index < 0)
            throw misfit("has no field \"" + field.name + "\"");
        const OGRFieldType type = OGR_Fld_GetType(OGR_FD_GetFieldDefn(fields, index));
        if (!type_fits(field.type, type))
            throw misfit("has field \"" + field.name + "\" with type " + OGR_GetFieldTypeName(type));
        indices.push_back(index);
    }
    return indices;
}

OGRLayerH layer_called(GDALDatasetH dataset, const VectorFormat& format, const std::string& name) {
    const GdalMessages quiet;
    OGRLayerH layer = GDALDatasetGetLayerByName(dataset, name.c_str());
    return layer == nullptr && !format.several_layers ? GDALDatasetGetLayer(dataset, 0) : layer;
}

void require_same_origin(OGRLayerH layer, const Provenance& provenance, const WriteTarget& target) {
    for (const std::string& name : provenance.binding) {
        const char* there = GDALGetMetadataItem(layer, name.c_str(), nullptr);
        const auto ours = provenance.metadata.find(name);
        if (there != nullptr && ours != provenance.metadata.end() && ours->second != there)
            throw OutputError("Cannot append to \"" + target.name + "\": its layer \"" +
                              OGR_L_GetName(layer) + "\" has " + name + " \"" + there +
                              "\" and the result \"" + ours->second + "\"; write to another destination.");
    }
}

}  // namespace d2b

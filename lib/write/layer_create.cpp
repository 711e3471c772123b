#include "write/layer_create.hpp"

#include <gdal_version.h>

#include "write/sql.hpp"

namespace d2b {

namespace {

/// Returns a real type for formats without 64-bit integers, such as MapInfo; it is exact for all our counts.
OGRFieldType integer_type(GDALDriverH driver) {
    const char* known = GDALGetMetadataItem(driver, GDAL_DMD_CREATIONFIELDDATATYPES, nullptr);
    return known == nullptr || std::string(known).find("Integer64") != std::string::npos ? OFTInteger64
                                                                                         : OFTReal;
}

OGRFieldType ogr_type(FieldType type, GDALDriverH driver) {
    switch (type) {
        case FieldType::integer:
            return integer_type(driver);
        case FieldType::real:
            return OFTReal;
        case FieldType::text:
            break;
    }
    return OFTString;
}

/// True if another layer has the title, because titles in a GeoPackage must be unique. Ignores errors that
/// GDAL reports about views on the layer being replaced, because it will exist again.
bool title_taken(GDALDatasetH dataset, const std::string& title) {
    const GdalMessages quiet;
    if (EQUAL(GDALGetDriverShortName(GDALGetDatasetDriver(dataset)), "GPKG"))
        return sql_value(dataset, "SELECT 1 FROM gpkg_contents WHERE identifier = " + sql_text(title))
            .has_value();
    for (int i = 0; i < GDALDatasetGetLayerCount(dataset); ++i) {
        const char* other = GDALGetMetadataItem(GDALDatasetGetLayer(dataset, i), "IDENTIFIER", nullptr);
        if (other != nullptr && title == other)
            return true;
    }
    return false;
}

NameValueList layer_options(GDALDatasetH dataset, const LayerSpec& spec, const LayerSetting& setting) {
    NameValueList options(setting.options);
    const auto offer = [&](const char* name, const std::string& value) {
        if (!value.empty() && !options.has(name) && has_layer_option(setting.format.driver, name))
            options.set(name, value);
    };
    offer("IDENTIFIER", title_taken(dataset, spec.title) ? spec.title + " (" + spec.name + ")" : spec.title);
    offer("DESCRIPTION", spec.description);
    // Temporary files belong next to the result, not into the working directory.
    offer("TEMPORARY_DIR", setting.target.hidden_folder);
    // By default these drivers silently drop geometries and characters.
    if (setting.format.name == "CSV")
        offer("GEOMETRY", "AS_WKT");
    if (setting.format.name == "ESRI Shapefile")
        offer("ENCODING", "UTF-8");
    return options;
}

FieldOwner field_of(const FieldSpec& spec, GDALDriverH driver) {
    FieldOwner field(OGR_Fld_Create(spec.name.c_str(), ogr_type(spec.type, driver)));
    if (!spec.alias.empty())
        OGR_Fld_SetAlternativeName(field.get(), spec.alias.c_str());
#if GDAL_VERSION_NUM >= GDAL_COMPUTE_VERSION(3, 7, 0)
    if (!spec.description.empty())
        OGR_Fld_SetComment(field.get(), spec.description.c_str());
#endif
    return field;
}

OGRwkbGeometryType geometry_type(const LayerSpec& spec, GDALDriverH driver) {
    if (spec.points)
        return wkbPoint;
    const bool curves =
        spec.with_arcs && GDALGetMetadataItem(driver, GDAL_DCAP_CURVE_GEOMETRIES, nullptr) != nullptr;
    if (curves)
        return spec.with_z ? wkbMultiSurfaceZ : wkbMultiSurface;
    return spec.with_z ? wkbMultiPolygon25D : wkbMultiPolygon;
}

}  // namespace

CrsOwner srs_of(const std::string& wkt, const WriteTarget& target) {
    if (wkt.empty())
        return nullptr;
    OgrCall call(target);
    CrsOwner srs(OSRNewSpatialReference(wkt.c_str()));
    call.check(srs != nullptr, "reading the CRS");
    OSRSetAxisMappingStrategy(srs.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return srs;
}

OGRLayerH create_layer(GDALDatasetH dataset, const LayerSpec& spec, const LayerSetting& setting) {
    OgrCall call(setting.target);
    const NameValueList options = layer_options(dataset, spec, setting);
    // const_cast because the C API of GDAL 3.6 takes a mutable list, but does not change it.
    OGRLayerH layer =
        GDALDatasetCreateLayer(dataset, spec.name.c_str(), setting.srs,
                               geometry_type(spec, setting.format.driver), const_cast<char**>(options.get()));
    call.check(layer != nullptr, "creating layer \"" + spec.name + "\"");
    const bool keeps_none =
        OGR_FD_GetGeomFieldCount(OGR_L_GetLayerDefn(layer)) == 0 || OGR_L_GetGeomType(layer) == wkbNone;
    if (keeps_none && setting.target.warnings != nullptr && !options.has("GEOMETRY"))
        setting.target.warnings->add("Layer \"" + spec.name + "\" of \"" + setting.target.name +
                                     "\" gets no geometries: " + setting.format.name +
                                     " does not keep them.");
    return layer;
}

std::vector<int> create_fields(OGRLayerH layer, const LayerSpec& spec, const LayerSetting& setting) {
    std::vector<int> indices;
    for (const FieldSpec& field : spec.fields) {
        OgrCall call(setting.target);
        const bool done =
            OGR_L_CreateField(layer, field_of(field, setting.format.driver).get(), TRUE) == OGRERR_NONE;
        call.check(done, "creating field \"" + field.name + "\" of layer \"" + spec.name + "\"");
        OGRFeatureDefnH fields = OGR_L_GetLayerDefn(layer);
        const int index = OGR_FD_GetFieldIndex(fields, field.name.c_str());
        // If the driver has renamed the field, it is the last one.
        indices.push_back(index >= 0 ? index : OGR_FD_GetFieldCount(fields) - 1);
    }
    return indices;
}

}  // namespace d2b

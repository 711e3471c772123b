#include "write/trial_dataset.hpp"

#include <array>

#include "write/vector_format.hpp"

namespace d2b {

std::string trial_name(GDALDriverH driver, const std::string& destination) {
    if (is_stream(destination)) {
        const char* extension = GDALGetMetadataItem(driver, GDAL_DMD_EXTENSION, nullptr);
        return extension == nullptr ? "probe" : "probe." + std::string(extension);
    }
    const auto slash = destination.find_last_not_of('/');
    const std::string path = destination.substr(0, slash == std::string::npos ? 0 : slash + 1);
    const std::string file = path.substr(path.find_last_of('/') + 1);
    const auto dot = file.find('.', 1);
    return dot == std::string::npos ? "probe" : "probe" + file.substr(dot);
}

OGRLayerH add_trial_layer(GDALDatasetH dataset, const char* name, OGRSpatialReferenceH srs) {
    return GDALDatasetCreateLayer(dataset, name, srs, wkbMultiPolygon, nullptr);
}

bool add_trial_feature(OGRLayerH layer, const Position& place) {
    constexpr double size = 1e-4;
    const FieldOwner field(OGR_Fld_Create("id", OFTInteger64));
    OGR_L_CreateField(layer, field.get(), TRUE);
    const FeatureOwner feature(OGR_F_Create(OGR_L_GetLayerDefn(layer)));
    OGRGeometryH ring = OGR_G_CreateGeometry(wkbLinearRing);
    for (const Position& corner :
         {place, Position{place.x + size, place.y}, Position{place.x + size, place.y + size}, place})
        OGR_G_AddPoint_2D(ring, corner.x, corner.y);
    OGRGeometryH polygon = OGR_G_CreateGeometry(wkbPolygon);
    OGR_G_AddGeometryDirectly(polygon, ring);
    OGRGeometryH whole = OGR_G_CreateGeometry(wkbMultiPolygon);
    OGR_G_AddGeometryDirectly(whole, polygon);
    OGR_F_SetGeometryDirectly(feature.get(), whole);
    if (OGR_F_GetFieldCount(feature.get()) > 0)
        OGR_F_SetFieldInteger64(feature.get(), 0, 1);
    return OGR_L_CreateFeature(layer, feature.get()) == OGRERR_NONE;
}

DatasetOwner reopen_trial(GDALDriverH driver, const std::string& file) {
    const std::array<const char*, 2> only{GDALGetDriverShortName(driver), nullptr};
    return DatasetOwner(GDALOpenEx(file.c_str(), GDAL_OF_VECTOR, only.data(), nullptr, nullptr));
}

bool says_yes(GDALDriverH driver, const char* capability) {
    const char* value = GDALGetMetadataItem(driver, capability, nullptr);
    return value != nullptr && EQUAL(value, "YES");
}

}  // namespace d2b

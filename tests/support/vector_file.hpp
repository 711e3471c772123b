#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gdal.h>
#include <gtest/gtest.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

namespace d2b::test {

struct VectorFeature {
    std::string wkt;  ///< "" for no geometry
    std::optional<double> height = {};
};

/// A layer with a field of heights.
struct VectorLayer {
    std::string name = "buildings";
    std::vector<VectorFeature> features = {};
    int epsg = 25832;  ///< 0 for no CRS
    std::string height_field = "height";
    OGRFieldType height_type = OFTReal;
    OGRwkbGeometryType geometry = wkbUnknown;
    const char* driver = "GPKG";
};

/// Adds a layer to a dataset, which is made where it is not there.
inline void write_layer(const std::string& path, const VectorLayer& spec) {
    GDALDatasetH dataset =
        GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE, nullptr, nullptr, nullptr);
    if (dataset == nullptr)
        dataset = GDALCreate(GDALGetDriverByName(spec.driver), path.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
    ASSERT_NE(dataset, nullptr) << path;
    OGRSpatialReferenceH crs = nullptr;
    if (spec.epsg != 0) {
        crs = OSRNewSpatialReference(nullptr);
        OSRImportFromEPSG(crs, spec.epsg);
        OSRSetAxisMappingStrategy(crs, OAMS_TRADITIONAL_GIS_ORDER);
    }
    OGRLayerH layer = GDALDatasetCreateLayer(dataset, spec.name.c_str(), crs, spec.geometry, nullptr);
    ASSERT_NE(layer, nullptr) << spec.name;
    if (!spec.height_field.empty()) {
        OGRFieldDefnH field = OGR_Fld_Create(spec.height_field.c_str(), spec.height_type);
        OGR_L_CreateField(layer, field, TRUE);
        OGR_Fld_Destroy(field);
    }
    for (const VectorFeature& one : spec.features) {
        OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(layer));
        OGRGeometryH geometry = nullptr;
        std::string wkt = one.wkt;
        char* text = wkt.data();
        if (!wkt.empty()) {
            ASSERT_EQ(OGR_G_CreateFromWkt(&text, nullptr, &geometry), OGRERR_NONE) << wkt;
            OGR_F_SetGeometryDirectly(feature, geometry);
        }
        if (one.height)
            OGR_F_SetFieldDouble(feature, 0, *one.height);
        EXPECT_EQ(OGR_L_CreateFeature(layer, feature), OGRERR_NONE) << wkt;
        OGR_F_Destroy(feature);
    }
    if (crs != nullptr)
        OSRRelease(crs);
    GDALClose(dataset);
}

}  // namespace d2b::test

#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gdal.h>
#include <gtest/gtest.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include "core/text.hpp"

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

struct RowField {
    std::string name;
    OGRFieldType type = OFTString;
};

struct VectorRow {
    std::string wkt;                                 ///< "" for no geometry
    std::vector<std::optional<std::string>> values;  ///< one per field; nothing for NULL
};

/// A layer with any fields.
struct RowLayer {
    std::string name;
    std::vector<RowField> fields = {};
    std::vector<VectorRow> rows = {};
    int epsg = 25832;  ///< 0 for no CRS
    OGRwkbGeometryType geometry = wkbUnknown;
    const char* driver = "GPKG";
};

inline void write_row(OGRLayerH layer, const VectorRow& row) {
    OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(layer));
    OGRGeometryH geometry = nullptr;
    std::string wkt = row.wkt;
    char* text = wkt.data();
    if (!wkt.empty()) {
        ASSERT_EQ(OGR_G_CreateFromWkt(&text, nullptr, &geometry), OGRERR_NONE) << wkt;
        OGR_F_SetGeometryDirectly(feature, geometry);
    }
    for (std::size_t i = 0; i < row.values.size(); ++i)
        if (row.values[i])
            OGR_F_SetFieldString(feature, static_cast<int>(i), row.values[i]->c_str());
    EXPECT_EQ(OGR_L_CreateFeature(layer, feature), OGRERR_NONE) << wkt;
    OGR_F_Destroy(feature);
}

/// Adds a layer to a dataset, which is made where it is not there.
inline void write_rows(const std::string& path, const RowLayer& spec) {
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
    for (const RowField& one : spec.fields) {
        OGRFieldDefnH field = OGR_Fld_Create(one.name.c_str(), one.type);
        OGR_L_CreateField(layer, field, TRUE);
        OGR_Fld_Destroy(field);
    }
    for (const VectorRow& row : spec.rows)
        write_row(layer, row);
    if (crs != nullptr)
        OSRRelease(crs);
    GDALClose(dataset);
}

/// The same of a layer with heights.
inline void write_layer(const std::string& path, const VectorLayer& spec) {
    RowLayer rows{.name = spec.name, .epsg = spec.epsg, .geometry = spec.geometry, .driver = spec.driver};
    if (!spec.height_field.empty())
        rows.fields.push_back({spec.height_field, spec.height_type});
    for (const VectorFeature& one : spec.features) {
        rows.rows.push_back({one.wkt, {}});
        if (one.height)
            rows.rows.back().values.emplace_back(number_text(*one.height));
    }
    write_rows(path, rows);
}

}  // namespace d2b::test

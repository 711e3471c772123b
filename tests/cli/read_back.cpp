#include "cli/read_back.hpp"

#include <gtest/gtest.h>
#include <ogr_srs_api.h>

namespace d2b::test {
namespace {

/// Rings of a Polygon or MultiPolygon.
std::vector<OGRGeometryH> rings_of(OGRGeometryH geometry) {
    std::vector<OGRGeometryH> rings;
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i) {
        OGRGeometryH part = OGR_G_GetGeometryRef(geometry, i);
        if (OGR_G_GetGeometryCount(part) == 0)
            rings.push_back(part);
        for (OGRGeometryH ring : rings_of(part))
            rings.push_back(ring);
    }
    return rings;
}

int polygons_in(OGRGeometryH geometry) {
    return OGR_GT_Flatten(OGR_G_GetGeometryType(geometry)) == wkbPolygon ? 1
                                                                         : OGR_G_GetGeometryCount(geometry);
}

std::string name_of(OGRSpatialReferenceH crs) {
    const char* name = crs == nullptr ? nullptr : OSRGetName(crs);
    return name == nullptr ? "" : name;
}

}  // namespace

int Record::index(const std::string& field) const {
    const int at = OGR_F_GetFieldIndex(feature_.get(), field.c_str());
    EXPECT_GE(at, 0) << "there is no field " << field;
    return at;
}

bool Record::is_null(const std::string& field) const {
    return OGR_F_IsFieldSetAndNotNull(feature_.get(), index(field)) == FALSE;
}

double Record::number(const std::string& field) const {
    EXPECT_FALSE(is_null(field)) << field;
    return OGR_F_GetFieldAsDouble(feature_.get(), index(field));
}

std::string Record::text(const std::string& field) const {
    return OGR_F_GetFieldAsString(feature_.get(), index(field));
}

std::string Record::wkt() const {
    char* text = nullptr;
    OGR_G_ExportToIsoWkt(geometry(), &text);
    std::string result = text == nullptr ? "" : text;
    VSIFree(text);
    return result;
}

OGREnvelope Record::box() const {
    OGREnvelope box{};
    OGR_G_GetEnvelope(geometry(), &box);
    return box;
}

int Record::vertices() const {
    int count = 0;
    for (OGRGeometryH ring : rings_of(geometry()))
        count += OGR_G_GetPointCount(ring);
    return count;
}

int Record::holes() const {
    return static_cast<int>(rings_of(geometry()).size()) - polygons_in(geometry());
}

double Layer::sum(const std::string& field, int level) const {
    double total = 0;
    for (const Record& record : records)
        if (level < 0 || record.number("level") == level)
            total += record.number(field);
    return total;
}

int Layer::count(int level) const {
    int n = 0;
    for (const Record& record : records)
        n += record.number("level") == level ? 1 : 0;
    return n;
}

const Record& Layer::where(const std::string& field, double value) const {
    const Record* found = nullptr;
    for (const Record& record : records)
        if (record.number(field) == value) {
            EXPECT_EQ(found, nullptr) << "two records have " << field << " " << value;
            found = &record;
        }
    if (found == nullptr)
        throw std::runtime_error("no record of " + name + " has " + field + " " + std::to_string(value));
    return *found;
}

OpenDataset open_vector(const std::string& path) {
    OpenDataset dataset(
        GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
    EXPECT_TRUE(dataset) << path << " cannot be opened";
    return dataset;
}

std::vector<std::string> layer_names(const std::string& path) {
    std::vector<std::string> names;
    if (const OpenDataset dataset = open_vector(path))
        for (int i = 0; i < GDALDatasetGetLayerCount(dataset.get()); ++i)
            names.emplace_back(OGR_L_GetName(GDALDatasetGetLayer(dataset.get(), i)));
    std::erase(names, "layer_styles");
    return names;
}

Layer read_layer(const std::string& path, const std::string& name) {
    Layer result;
    const OpenDataset dataset = open_vector(path);
    OGRLayerH layer = dataset ? GDALDatasetGetLayerByName(dataset.get(), name.c_str()) : nullptr;
    EXPECT_NE(layer, nullptr) << path << " has no layer " << name;
    if (layer == nullptr)
        return result;
    result.name = name;
    result.crs = name_of(OGR_L_GetSpatialRef(layer));
    result.geometry_column = OGR_L_GetGeometryColumn(layer);
    result.type = OGR_L_GetGeomType(layer);
    OGRFeatureDefnH fields = OGR_L_GetLayerDefn(layer);
    for (int i = 0; i < OGR_FD_GetFieldCount(fields); ++i)
        result.fields.emplace_back(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(fields, i)));
    for (CSLConstList item = GDALGetMetadata(layer, nullptr); item != nullptr && *item != nullptr; ++item) {
        const std::string pair(*item);
        result.metadata[pair.substr(0, pair.find('='))] = pair.substr(pair.find('=') + 1);
    }
    OGR_L_ResetReading(layer);
    while (OGRFeatureH feature = OGR_L_GetNextFeature(layer))
        result.records.emplace_back(feature);
    return result;
}

std::string sql_value(const std::string& path, const std::string& statement) {
    const OpenDataset dataset = open_vector(path);
    OGRLayerH rows =
        dataset ? GDALDatasetExecuteSQL(dataset.get(), statement.c_str(), nullptr, nullptr) : nullptr;
    if (rows == nullptr)
        return "";
    const reading::FeatureOwner row(OGR_L_GetNextFeature(rows));
    std::string value = row ? OGR_F_GetFieldAsString(row.get(), 0) : "";
    GDALDatasetReleaseResultSet(dataset.get(), rows);
    return value;
}

std::string crs_name(const std::string& definition) {
    OGRSpatialReferenceH crs = OSRNewSpatialReference(nullptr);
    OSRSetFromUserInput(crs, definition.c_str());
    std::string name = name_of(crs);
    OSRDestroySpatialReference(crs);
    return name;
}

}  // namespace d2b::test

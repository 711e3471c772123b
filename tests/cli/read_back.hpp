#pragma once

#include <map>
#include <string>
#include <vector>

#include <gdal.h>
#include <ogr_api.h>

#include "read/gdal_handles.hpp"

namespace d2b::test {

using OpenDataset = reading::DatasetOwner;

/// One feature as it was read.
class Record {
  public:
    explicit Record(OGRFeatureH feature) : feature_(feature) {}

    [[nodiscard]] bool is_null(const std::string& field) const;
    [[nodiscard]] double number(const std::string& field) const;
    [[nodiscard]] std::string text(const std::string& field) const;
    [[nodiscard]] OGRGeometryH geometry() const { return OGR_F_GetGeometryRef(feature_.get()); }
    [[nodiscard]] std::string wkt() const;
    /// Area in the plane of the CRS.
    [[nodiscard]] double area() const { return OGR_G_Area(geometry()); }
    [[nodiscard]] bool valid() const { return OGR_G_IsValid(geometry()) != 0; }
    [[nodiscard]] OGREnvelope box() const;
    /// Positions of all rings; the closing ones count.
    [[nodiscard]] int vertices() const;
    /// Rings that are holes.
    [[nodiscard]] int holes() const;

  private:
    int index(const std::string& field) const;
    reading::FeatureOwner feature_;
};

struct Layer {
    std::string name;
    std::vector<std::string> fields;
    std::string crs;  ///< name of its CRS, "" where it has none
    std::string geometry_column;
    OGRwkbGeometryType type = wkbUnknown;
    std::map<std::string, std::string> metadata;
    std::vector<Record> records;

    /// The sum of a field over all records, or over those of one level where the layer has levels.
    [[nodiscard]] double sum(const std::string& field, int level = -1) const;
    [[nodiscard]] int count(int level) const;
    /// The only record that has this value; fails the test where there is none.
    [[nodiscard]] const Record& where(const std::string& field, double value) const;
};

/// Fails the test where the file cannot be opened.
[[nodiscard]] OpenDataset open_vector(const std::string& path);
/// Names without QGIS's table of styles, which OGR lists, too.
[[nodiscard]] std::vector<std::string> layer_names(const std::string& path);
/// An empty layer without a name where there is none of this one, and a failed test.
[[nodiscard]] Layer read_layer(const std::string& path, const std::string& name);
/// The first value that a statement gives; "" where there is none.
[[nodiscard]] std::string sql_value(const std::string& path, const std::string& statement);
[[nodiscard]] std::string crs_name(const std::string& definition);

}  // namespace d2b::test

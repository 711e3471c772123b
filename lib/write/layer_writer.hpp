#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"
#include "dem2buildings/wkb.hpp"
#include "write/ogr_call.hpp"
#include "write/ogr_handles.hpp"
#include "write/spatial_index.hpp"
#include "write/vector_format.hpp"

namespace d2b {

/// Settings shared by all layers of a run.
struct LayerSetting {
    const WriteTarget& target;
    const VectorFormat& format;
    const std::vector<std::string>& options;  ///< -lco
    OGRSpatialReferenceH srs = nullptr;       ///< null for none
};

/// Writes features into one layer of an open dataset, reusing one OGR feature and one WKB buffer.
class LayerWriter {
  public:
    /// Creates a layer. @throws OutputError
    static LayerWriter create(GDALDatasetH dataset, const LayerSpec& spec, const LayerSetting& setting);
    /// Opens an existing layer. @throws OutputError if its fields, geometry type or CRS do not match
    static LayerWriter adopt(OGRLayerH layer, const LayerSpec& spec, const LayerSetting& setting);

    /// Defers the spatial index of a new, empty layer of a GeoPackage to finish().
    void index_at_end(GDALDatasetH dataset);
    /// @throws OutputError
    void add(const Feature& feature);
    /// Call after the last feature. @throws OutputError
    void finish();

    [[nodiscard]] const std::string& name() const { return name_; }  ///< name given by the driver
    /// Number of features that the layer should hold now.
    [[nodiscard]] std::int64_t expected() const { return expected_; }
    [[nodiscard]] OGRLayerH handle() const { return layer_; }
    /// Sets the count found by SQL, which is more reliable than that of the driver.
    void expect(std::int64_t features) { expected_ = features; }
    [[nodiscard]] bool is_new() const { return is_new_; }
    /// Returns the column names of the driver, one per field of the spec.
    [[nodiscard]] std::vector<std::string> columns() const;

  private:
    LayerWriter(OGRLayerH layer, const LayerSpec& spec, const LayerSetting& setting, std::vector<int> fields);
    void set(int field, const FieldValue& value);
    /// Describes a feature in messages.
    [[nodiscard]] std::string text_of(const Feature& feature) const;

    OGRLayerH layer_;
    std::string name_;
    const WriteTarget* target_;
    std::vector<int> fields_;  ///< layer field index per field of the spec
    bool has_geometry_;
    bool is_new_ = false;
    std::int64_t expected_ = 0;
    std::int64_t next_fid_ = OGRNullFID;  ///< set if the driver does not append new features by itself
    FeatureOwner feature_;
    MultiPolygonWkb wkb_;
    std::optional<SpatialIndex> index_;
};

}  // namespace d2b

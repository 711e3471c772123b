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

/// What all layers of a run share.
struct LayerSetting {
    const WriteTarget& target;
    const VectorFormat& format;
    const std::vector<std::string>& options;  ///< -lco
    OGRSpatialReferenceH srs = nullptr;       ///< null for none
};

/// Writes features into one layer of an open dataset, by way of one OGR feature and one buffer.
class LayerWriter {
  public:
    /// A new layer. @throws OutputError
    static LayerWriter create(GDALDatasetH dataset, const LayerSpec& spec, const LayerSetting& setting);
    /// A layer that is there. @throws OutputError where its fields, geometries or CRS do not fit
    static LayerWriter adopt(OGRLayerH layer, const LayerSpec& spec, const LayerSetting& setting);

    /// Of a new layer of a GeoPackage that is empty yet: its index is made when it is finished.
    void index_at_end(GDALDatasetH dataset);
    /// @throws OutputError
    void add(const Feature& feature);
    /// After the last feature. @throws OutputError
    void finish();

    [[nodiscard]] const std::string& name() const { return name_; }  ///< as the driver calls it
    /// Features that the layer should hold now.
    [[nodiscard]] std::int64_t expected() const { return expected_; }
    [[nodiscard]] OGRLayerH handle() const { return layer_; }
    /// Where a database has counted better than the driver.
    void expect(std::int64_t features) { expected_ = features; }
    [[nodiscard]] bool is_new() const { return is_new_; }
    /// Of each field of the spec, as the driver calls it.
    [[nodiscard]] std::vector<std::string> columns() const;

  private:
    LayerWriter(OGRLayerH layer, const LayerSpec& spec, const LayerSetting& setting, std::vector<int> fields);
    void set(int field, const FieldValue& value);
    /// For messages.
    [[nodiscard]] std::string text_of(const Feature& feature) const;

    OGRLayerH layer_;
    std::string name_;
    const WriteTarget* target_;
    std::vector<int> fields_;  ///< index in the layer of each field of the spec
    bool has_geometry_;
    bool is_new_ = false;
    std::int64_t expected_ = 0;
    std::int64_t next_fid_ = OGRNullFID;  ///< where the driver does not put new features at the end by itself
    FeatureOwner feature_;
    MultiPolygonWkb wkb_;
    std::optional<SpatialIndex> index_;
};

}  // namespace d2b

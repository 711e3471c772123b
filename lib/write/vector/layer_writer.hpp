#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"
#include "dem2buildings/wkb.hpp"
#include "read/original_layer.hpp"
#include "write/geopackage/spatial_index.hpp"
#include "write/ogr_util.hpp"
#include "write/vector/vector_format.hpp"

namespace d2b::writing {

/// Settings shared by all layers of a run.
struct LayerSettings {
    const WriteTarget& target;
    const VectorFormat& format;
    const std::vector<std::string>& options;  ///< -lco
    OGRSpatialReferenceH srs = nullptr;       ///< null for none
};

/// Writes features into one layer of an open dataset, reusing one OGR feature and one WKB buffer.
class LayerWriter {
  public:
    /// Creates a layer. @throws OutputError
    static LayerWriter create(GDALDatasetH dataset, const LayerSpec& spec, const LayerSettings& setting);
    /// Opens an existing layer. @throws OutputError if its fields, geometry type or CRS do not match
    static LayerWriter adopt(OGRLayerH layer, const LayerSpec& spec, const LayerSettings& setting);

    /// Defers the spatial index of a new, empty layer of a GeoPackage to finish().
    void defer_index(GDALDatasetH dataset);
    /// @throws OutputError
    void add(const Feature& feature);
    /// Call after the last feature. @throws OutputError
    void finish();

    [[nodiscard]] const std::string& name() const { return name_; }  ///< name given by the driver
    /// Number of features that the layer should hold now.
    [[nodiscard]] std::int64_t feature_count() const { return feature_count_; }
    [[nodiscard]] OGRLayerH handle() const { return layer_; }
    /// Sets the count found by SQL, which is more reliable than that of the driver.
    void set_feature_count(std::int64_t features) { feature_count_ = features; }
    [[nodiscard]] bool is_new() const { return is_new_; }
    /// Returns the added values of the field that determines the colour. Call once.
    [[nodiscard]] std::vector<double> take_heights() { return std::move(heights_); }
    /// Returns the column names of the driver, one per field of the spec.
    [[nodiscard]] std::vector<std::string> columns() const;

  private:
    LayerWriter(OGRLayerH layer, const LayerSpec& spec, const LayerSettings& setting,
                std::vector<int> fields);
    void set(int field, const FieldValue& value);
    /// @return null if OGR refuses it; owned by the caller
    [[nodiscard]] OGRGeometryH make_geometry(const Feature& feature);
    /// Gives the next feature the geometry, number and fields of an original.
    void copy_original(const Feature& feature);
    /// Describes a feature in messages.
    [[nodiscard]] std::string text_of(const Feature& feature) const;

    OGRLayerH layer_;
    std::string name_;
    const WriteTarget* target_;
    std::vector<int> fields_;                  ///< layer field index per field of the spec
    std::optional<std::size_t> height_field_;  ///< index in the spec
    std::vector<double> heights_;
    bool has_geometry_;
    bool is_new_ = false;
    std::int64_t feature_count_ = 0;
    std::int64_t next_fid_ = OGRNullFID;  ///< set if the driver does not append new features by itself
    reading::FeatureOwner feature_;
    MultiPolygonWkb wkb_;
    const reading::OgrOriginalLayer* original_;  ///< null if features are drawn here
    std::vector<int> copied_fields_;             ///< layer field index per field of the original
    std::optional<SpatialIndex> index_;
};

/// @return null if there is no CRS @throws OutputError
[[nodiscard]] reading::CrsOwner srs_of(const std::string& wkt, const WriteTarget& target);

/// Checks that features of the spec can be appended to an existing layer: same CRS, MultiPolygons with or
/// without Z alike, and all fields with types that keep the values. @return layer field index per field of
/// the spec @throws OutputError naming the mismatch
[[nodiscard]] std::vector<int> match_fields(OGRLayerH layer, const LayerSpec& spec,
                                            const LayerSettings& setting);

/// Returns the layer of that name, or the only one if a file is one layer; null if there is none.
[[nodiscard]] OGRLayerH find_layer(GDALDatasetH dataset, const VectorFormat& format, const std::string& name);

/// Checks that an existing layer has the same provenance, so that features can be appended.
/// @throws OutputError naming the difference
void require_same_provenance(OGRLayerH layer, const Provenance& provenance, const WriteTarget& target);

/// Returns the largest feature id of the layers, which is in their first field; 0 if there is none. Queries
/// the database within its transaction. @throws OutputError
[[nodiscard]] std::int64_t largest_id(const WriteTarget& target, GDALDatasetH database,
                                      std::span<const LayerSpec> layers);

/// Same for files, which are read completely. @throws OutputError, also if a layer ends early, because ids
/// would then be assigned twice
[[nodiscard]] std::int64_t largest_id(const WriteTarget& target, const VectorFormat& format,
                                      const std::string& path, std::span<const LayerSpec> layers);

/// Layer names with the expected number of features.
using LayerCounts = std::vector<std::pair<std::string, std::int64_t>>;

/// Counts rows by SQL, because the driver may return a cached number. @throws OutputError
[[nodiscard]] std::int64_t count_rows(const WriteTarget& target, GDALDatasetH dataset,
                                      const std::string& layer);

/// Compares with the open database before the commit. @throws OutputError
void check_counts(const WriteTarget& target, GDALDatasetH dataset, const LayerCounts& counts);

/// Reopens the result and compares. Skips formats that GDAL cannot read. @throws OutputError if a layer or
/// feature is missing
void verify_counts(const WriteTarget& target, const VectorFormat& format, const std::string& path,
                   const LayerCounts& counts);

}  // namespace d2b::writing

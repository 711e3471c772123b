#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <ogr_api.h>

#include "dem2buildings/sinks.hpp"
#include "read/gdal_handles.hpp"

namespace d2b::reading {

using DefinitionOwner = GdalOwner<OGRFeatureDefnH, OGR_FD_Release>;

/// Definition of a layer of OGR. Its features become bytes, so that they can wait in a spool, and come back
/// with all values, their number and their style. Of several geometries they keep the first.
class OgrOriginalLayer final : public OriginalLayer {
  public:
    /// Copies the definition, because the dataset may be closed before the features are written.
    explicit OgrOriginalLayer(OGRLayerH layer);

    [[nodiscard]] std::vector<std::string> field_names() const override;
    [[nodiscard]] OGRFeatureDefnH definition() const { return definition_.get(); }
    [[nodiscard]] OGRwkbGeometryType geometry_type() const { return OGR_FD_GetGeomType(definition_.get()); }
    /// Name of the column of feature numbers, and that of the geometries; "" if they have none.
    [[nodiscard]] const std::string& fid_column() const { return fid_column_; }
    [[nodiscard]] const std::string& geometry_column() const { return geometry_column_; }

    /// @param geometry written instead of that of the feature; may be null
    [[nodiscard]] std::vector<std::byte> encode(OGRFeatureH feature, OGRGeometryH geometry) const;
    /// @param bytes result of encode() of this layer
    [[nodiscard]] FeatureOwner decode(std::span<const std::byte> bytes) const;

  private:
    DefinitionOwner definition_;
    std::string fid_column_;
    std::string geometry_column_;
};

}  // namespace d2b::reading

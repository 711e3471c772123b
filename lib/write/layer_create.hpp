#pragma once

#include <string>
#include <vector>

#include "write/layer_writer.hpp"

namespace d2b {

/// @return null where there is none @throws OutputError
[[nodiscard]] CrsOwner srs_of(const std::string& wkt, const WriteTarget& target);

/// A new layer of MultiPolygons, or of points, with title and description where the format has a place for
/// them; options of the user's go first. Warns where the format keeps no geometries. @throws OutputError
[[nodiscard]] OGRLayerH create_layer(GDALDatasetH dataset, const LayerSpec& spec,
                                     const LayerSetting& setting);

/// @return the index in the layer of each field of the spec: drivers may have fields of their own
/// @throws OutputError
[[nodiscard]] std::vector<int> create_fields(OGRLayerH layer, const LayerSpec& spec,
                                             const LayerSetting& setting);

}  // namespace d2b

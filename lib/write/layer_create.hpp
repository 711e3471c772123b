#pragma once

#include <string>
#include <vector>

#include "write/layer_writer.hpp"

namespace d2b {

/// @return null if there is no CRS @throws OutputError
[[nodiscard]] CrsOwner srs_of(const std::string& wkt, const WriteTarget& target);

/// Creates a layer of MultiPolygons or points, with title and description if the format stores them; options
/// of the user take precedence. Warns if the format stores no geometries. @throws OutputError
[[nodiscard]] OGRLayerH create_layer(GDALDatasetH dataset, const LayerSpec& spec,
                                     const LayerSetting& setting);

/// @return layer field index per field of the spec, because drivers may add fields of their own
/// @throws OutputError
[[nodiscard]] std::vector<int> create_fields(OGRLayerH layer, const LayerSpec& spec,
                                             const LayerSetting& setting);

}  // namespace d2b

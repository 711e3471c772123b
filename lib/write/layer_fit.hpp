#pragma once

#include <vector>

#include "write/layer_writer.hpp"

namespace d2b {

/// Checks that features of the spec can be appended to an existing layer: same CRS, MultiPolygons with or
/// without Z alike, and all fields with types that keep the values. @return layer field index per field of
/// the spec @throws OutputError naming the mismatch
[[nodiscard]] std::vector<int> fitting_fields(OGRLayerH layer, const LayerSpec& spec,
                                              const LayerSetting& setting);

/// Returns the layer of that name, or the only one if a file is one layer; null if there is none.
[[nodiscard]] OGRLayerH layer_called(GDALDatasetH dataset, const VectorFormat& format,
                                     const std::string& name);

/// Checks that an existing layer has the same provenance, so that features can be appended.
/// @throws OutputError naming the difference
void require_same_origin(OGRLayerH layer, const Provenance& provenance, const WriteTarget& target);

}  // namespace d2b

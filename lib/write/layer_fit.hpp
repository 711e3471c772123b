#pragma once

#include <vector>

#include "write/layer_writer.hpp"

namespace d2b {

/// Whether features of the spec can be added to a layer that is there: its CRS is the same, it takes
/// MultiPolygons with or without Z alike, and has every field with a type that keeps the values.
/// @return the index in the layer of each field of the spec @throws OutputError with what does not fit
[[nodiscard]] std::vector<int> fitting_fields(OGRLayerH layer, const LayerSpec& spec,
                                              const LayerSetting& setting);

}  // namespace d2b

#pragma once

#include <vector>

#include "write/layer_writer.hpp"

namespace d2b {

/// Whether features of the spec can be added to a layer that is there: its CRS is the same, it takes
/// MultiPolygons with or without Z alike, and has every field with a type that keeps the values.
/// @return the index in the layer of each field of the spec @throws OutputError with what does not fit
[[nodiscard]] std::vector<int> fitting_fields(OGRLayerH layer, const LayerSpec& spec,
                                              const LayerSetting& setting);

/// The layer of a name; where a file is a layer, its name does not matter. Null where there is none.
[[nodiscard]] OGRLayerH layer_called(GDALDatasetH dataset, const VectorFormat& format,
                                     const std::string& name);

/// Whether features can stand beside those of a layer that is there: what the provenance binds is the same.
/// @throws OutputError with what is not
void require_same_origin(OGRLayerH layer, const Provenance& provenance, const WriteTarget& target);

}  // namespace d2b

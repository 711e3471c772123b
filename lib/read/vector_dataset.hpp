#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/context.hpp"
#include "read/gdal_handles.hpp"
#include "read/polygon_layer.hpp"

namespace d2b {

/// @throws InputError with GDAL's reason
[[nodiscard]] DatasetOwner open_vector_dataset(const std::string& path, Context& context);

/// Names of the layers that have geometries, in their order.
[[nodiscard]] std::vector<std::string> geometry_layers(GDALDatasetH dataset);

/// @throws InputError where there is no layer with geometries. @throws OptionError where the one that was
/// asked for is not there
[[nodiscard]] OGRLayerH pick_layer(GDALDatasetH dataset, const LayerChoice& choice);

/// WKT2:2019, "" for none.
[[nodiscard]] std::string wkt_of_layer(OGRLayerH layer);

/// "'a', 'b' and 'c'", or only the first of very many; "" for none.
[[nodiscard]] std::string quoted_names(std::span<const std::string> names);

}  // namespace d2b

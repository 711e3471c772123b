#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/warnings.hpp"
#include "read/gdal_handles.hpp"
#include "read/polygon_layer.hpp"

namespace d2b {

/// Opens a dataset with vector layers. @param complaint "'x' cannot be opened", before GDAL's reason @throws
/// InputError
[[nodiscard]] DatasetOwner open_vector_dataset(const std::string& path, const std::string& complaint,
                                               Warnings& warnings);

/// Names of layers with geometries, in order.
[[nodiscard]] std::vector<std::string> geometry_layers(GDALDatasetH dataset);

/// Returns the layer that `choice` names. @throws InputError if there is no layer with geometries. @throws
/// OptionError if the requested one does not exist
[[nodiscard]] OGRLayerH pick_layer(GDALDatasetH dataset, const LayerChoice& choice);

/// Calls visit(feature, geometry) for all features of a layer whose geometry is not empty.
/// @param what "The layer 'x' of 'y'", for messages @throws InputError if it cannot be read to its end
void for_each_geometry(OGRLayerH layer, const std::string& what, Warnings& warnings,
                       const std::function<void(OGRFeatureH, OGRGeometryH)>& visit);

/// Formats "'a', 'b' and 'c'", shortened if there are very many; "" for none.
[[nodiscard]] std::string quoted_names(std::span<const std::string> names);

}  // namespace d2b

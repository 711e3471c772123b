#pragma once

#include <vector>

#include "dem2buildings/sinks.hpp"
#include "features/layer_specs.hpp"
#include "features/write_features.hpp"

namespace d2b {

/// Styles of buildings and contours without the placement of 3D blocks. @param disjoint true if contours are
/// bands
[[nodiscard]] LayerStyle building_style(FieldNames names);
[[nodiscard]] LayerStyle contour_style(bool disjoint);

/// Sets the default styles of the input's layers: the same height classes in metres for all, contours ordered
/// from low to high, and in 3D the stack, or blocks of buildings if no contours are written.
/// @param vertical_metres metres per vertical unit of the DEM
void give_styles(std::vector<LayerSpec>& layers, const FeatureInput& input, double vertical_metres);

}  // namespace d2b

#pragma once

#include <vector>

#include "dem2buildings/sinks.hpp"
#include "features/layer_specs.hpp"
#include "features/write_features.hpp"

namespace d2b {

/// Of buildings and of contours, before solids are placed. @param disjoint whether contours are bands
[[nodiscard]] LayerStyle building_style(FieldNames names);
[[nodiscard]] LayerStyle contour_style(bool disjoint);

/// How the layers of the input are shown by default: all by the same classes of height in metres, contours
/// from low to high, and in 3D the stack, or where it is not written each building as a block.
/// @param vertical_metres metres in a vertical unit of the DEM
void give_styles(std::vector<LayerSpec>& layers, const FeatureInput& input, double vertical_metres);

}  // namespace d2b

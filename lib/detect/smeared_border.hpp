#pragma once

#include "core/executor.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Removes border cells that are less than half as high as the inner cells within two cells. A wall crosses
/// them, and in a blurred raster it stands at the points of half its height. Objects without inner cells keep
/// their border.
/// @param cells cells of objects; changed
void take_smeared_border_off(const Scene& scene, Mask& cells, Executor& threads);

}  // namespace d2b

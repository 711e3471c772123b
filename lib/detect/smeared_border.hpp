#pragma once

#include "core/executor.hpp"
#include "detect/scene.hpp"

namespace d2b {

/// Takes cells off the border of what stands that are less than half as high as what is beside them inside: a
/// wall runs through them, and where a raster smears it, it stands where the surface is at half its height.
/// Two cells around are looked at; what has no inside keeps its border.
/// @param cells of objects; changed
void take_smeared_border_off(const Scene& scene, Mask& cells, Executor& threads);

}  // namespace d2b

#pragma once

#include "dem2buildings/run.hpp"
#include "detect/detection.hpp"
#include "detect/scene.hpp"
#include "detect/unit_grid.hpp"

namespace d2b {

/// Writes what is asked for of the terrain, the heights above it, and those of plants: what rises by more
/// than `min_height` metres and is no building. Rows are made as they are written.
/// @param unit whose own cells are written @param scene what it sees @throws OutputError
void write_scene_rasters(const Sinks& sinks, const Scene& scene, const Detection& detection,
                         double min_height, const Unit& unit);

}  // namespace d2b

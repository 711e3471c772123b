#pragma once

#include "dem2buildings/run.hpp"
#include "detect/detection.hpp"
#include "detect/scene.hpp"
#include "detect/unit_grid.hpp"

namespace d2b {

/// Writes the requested rasters of a unit: terrain, heights above it, and canopy heights. Canopy is
/// everything higher than `min_height` metres that is not a building. Rows are computed while writing.
/// @param unit its own cells are written @param scene covers the unit's extent @throws OutputError
void write_scene_rasters(const Sinks& sinks, const Scene& scene, const Detection& detection,
                         double min_height, const Unit& unit);

}  // namespace d2b

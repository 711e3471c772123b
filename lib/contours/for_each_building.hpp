#pragma once

#include <functional>

#include "contours/merge_regions.hpp"
#include "core/band.hpp"
#include "core/context.hpp"
#include "detect/units.hpp"
#include "elevations/elevation_reader.hpp"

namespace d2b::contours {

/// Gathers the cells of each building in one pass over the DEM. Memory holds the buildings that the pass has
/// begun but not finished.
/// @param labels labels of the buildings, from 1 to `count`
/// @param window window of the DEM; rows and columns of the cells are those of its raster
/// @param stage to which the time of `use` is charged
/// @param use called once per building, on any thread
/// @throws Cancelled, InputError, and exceptions of `use`
void for_each_building(ElevationReader& reader, const detect::LabelRows& labels, Label count,
                       const Window& window, Stage stage, Context& context,
                       const std::function<void(Label, BuildingCells&&)>& use);

}  // namespace d2b::contours

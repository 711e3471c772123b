#pragma once

#include "dem2buildings/dem_source.hpp"
#include "preview/canvas.hpp"
#include "preview/map_frame.hpp"

namespace d2b {

/// Draws the surface as if lit from the north-west of the raster; white where no point is valid. Reads as
/// many rows as the picture has, whatever the size of the raster.
/// @param rise height of a unit of elevation, in widths of a cell
void draw_relief(DemSource& dem, const MapFrame& frame, double rise, Canvas& canvas);

}  // namespace d2b

#pragma once

#include <string>
#include <vector>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/sinks.hpp"
#include "read/placed_layer.hpp"
#include "read/ring_clip.hpp"

namespace d2b {

/// The rings of one polygon; a point is inside where it is inside of an odd number of them.
using PixelPolygon = std::vector<WorldRing>;

/// The polygons of a layer of a vector dataset in pixel coordinates of a DEM: x is columns, y is rows
/// (downwards), (0, 0) the outer corner of the first cell. Edges that bend on the way from the layer's CRS to
/// the DEM's are followed to a small part of a cell. What lies far from the window of the DEM may be left
/// out.
/// @param info georeferencing of the DEM
/// @throws InputError: cannot be opened or read, no polygons, a CRS where the DEM has none, not transformable
/// @throws OptionError: no such layer. Polygons near the window that are not valid are warned of
[[nodiscard]] std::vector<PixelPolygon> read_cutline(const PolygonPlace& place, const DemInfo& info,
                                                     Warnings& warnings);

/// Around all rings, in pixel coordinates.
[[nodiscard]] ClipBox box_of(const PixelPolygon& polygon);
[[nodiscard]] bool meets(const ClipBox& box, const Window& window);

}  // namespace d2b

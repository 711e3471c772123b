#pragma once

#include <string>
#include <vector>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/sinks.hpp"
#include "read/placed_layer.hpp"
#include "read/ring_clip.hpp"

namespace d2b {

/// Rings of one polygon under the even-odd rule.
using PixelPolygon = std::vector<WorldRing>;

/// Reads the polygons of a vector layer in pixel coordinates of a DEM: x is columns, y is rows (downwards),
/// (0, 0) the outer corner of the first cell. Edges that become curves between the CRS of the layer and that
/// of the DEM are densified to a small part of a cell. Parts far from the window of the DEM may be left out.
/// Warns of invalid polygons near the window.
/// @param info georeferencing of the DEM
/// @throws InputError: cannot be opened or read, no polygons, a CRS although the DEM has none, not
/// transformable
/// @throws OptionError: no such layer
[[nodiscard]] std::vector<PixelPolygon> read_cutline(const PolygonPlace& place, const DemInfo& info,
                                                     Warnings& warnings);

/// Envelope of all rings in pixel coordinates.
[[nodiscard]] ClipBox box_of(const PixelPolygon& polygon);
[[nodiscard]] bool meets(const ClipBox& box, const Window& window);

}  // namespace d2b

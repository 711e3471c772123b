#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"
#include "read/gdal_handles.hpp"
#include "read/ring_projection.hpp"
#include "read/vector_layer.hpp"

namespace d2b::reading {

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
[[nodiscard]] std::vector<PixelPolygon> read_cutline(const PolygonSource& source, const DemInfo& info,
                                                     Warnings& warnings);

/// Widens polygons by a distance; corners become arcs. Invalid polygons are those of their odd rings.
/// @param info grid of their pixel coordinates, which gives the size of a cell in metres
/// @throws InputError if GEOS fails
[[nodiscard]] std::vector<PixelPolygon> buffered(const std::vector<PixelPolygon>& polygons, double metres,
                                                 const DemInfo& info, const std::string& name);

/// Mask of the cells of a window whose centres lie inside any of the polygons.
class CutlineMask {
  public:
    CutlineMask(const std::vector<PixelPolygon>& polygons, const Window& window);

    /// Returns true if the envelope of any polygon overlaps the window.
    [[nodiscard]] bool meets_window() const { return !shapes_.empty(); }
    /// Sets cells outside to NaN. Thread-safe.
    /// @param part of the window @param elevations part.rows * part.cols values
    /// @throws InputError with GDAL's reason
    void apply(const Window& part, std::span<double> elevations);

  private:
    struct Shape {
        ClipBox box;  ///< envelope; y is rows
        GeometryOwner geometry;
    };
    void burn(const Window& strip);

    Window window_;
    std::mutex burning_;
    std::vector<Shape> shapes_;
    Window strip_;                      ///< cells rasterised last
    std::vector<std::uint8_t> inside_;  ///< one value per cell of the strip
};

/// Opens the cutline that the options name and warns if it does not overlap the window. Returns null if there
/// is no cutline. @throws InputError, OptionError as read_cutline()
[[nodiscard]] std::unique_ptr<CutlineMask> open_cutline(const ReadOptions& options, const DemInfo& info,
                                                        Warnings& warnings);

}  // namespace d2b::reading

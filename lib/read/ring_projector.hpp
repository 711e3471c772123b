#pragma once

#include <string>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/sinks.hpp"
#include "read/gdal_handles.hpp"

namespace d2b {

/// Takes rings from the CRS of a cutline or mask to pixel coordinates of a DEM.
class RingProjector {
  public:
    /// @param transform to the DEM's CRS, or nullptr; must outlive this
    /// @param grid the DEM's transform @param name of the polygons, for messages: "cutline 'area.shp'"
    RingProjector(OGRCoordinateTransformationH transform, const AffineTransform& grid, std::string name);

    /// Puts points in between on edges that are bent in the DEM's CRS, so that what remains is less than a
    /// fiftieth of a cell. @throws InputError where a position has no image
    [[nodiscard]] WorldRing project(const WorldRing& ring);

  private:
    struct Vertex {
        Position source;
        Position pixel;
    };
    [[nodiscard]] Position to_pixel(Position source) const;
    void add_between(const Vertex& from, const Vertex& to, int depth, WorldRing& ring) const;

    OGRCoordinateTransformationH transform_;
    AffineTransform to_cells_{};
    std::string name_;
};

}  // namespace d2b

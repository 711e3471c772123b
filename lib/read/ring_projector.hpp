#pragma once

#include <string>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/sinks.hpp"
#include "read/gdal_handles.hpp"

namespace d2b {

/// Projects rings from the CRS of a cutline or mask to pixel coordinates of a DEM.
class RingProjector {
  public:
    /// @param transform to the CRS of the DEM, or nullptr; must outlive this object
    /// @param grid transform of the DEM @param name of the polygons in messages: "cutline 'area.shp'"
    RingProjector(OGRCoordinateTransformationH transform, const AffineTransform& grid, std::string name);

    /// Projects a ring and densifies edges that become curves, so that they deviate by less than a fiftieth
    /// of a cell. @throws InputError if a position has no image
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

#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <ogr_srs_api.h>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/sinks.hpp"
#include "read/gdal_handles.hpp"

namespace d2b::reading {

/// Axis-parallel box, sides included; unbounded by default.
struct ClipBox {
    double left = -std::numeric_limits<double>::infinity();
    double bottom = -std::numeric_limits<double>::infinity();
    double right = std::numeric_limits<double>::infinity();
    double top = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool holds(std::span<const Position> ring) const;
};

/// Returns the envelope of rings. @param rings not empty
[[nodiscard]] ClipBox box_of(std::span<const WorldRing> rings);

/// Clips a ring to a box (Sutherland and Hodgman, 1974). Parts may be joined along the sides of the box;
/// within the box, points keep their even-odd parity. A ring inside the box is returned unchanged.
/// @param ring may be closed by a repeated position @return closed by a repeated position; empty if outside
/// of the box
[[nodiscard]] WorldRing clipped(const WorldRing& ring, const ClipBox& box);

/// Projects rings from the CRS of a cutline or mask to pixel coordinates of a DEM.
class RingProjector {
  public:
    /// @param transform to the CRS of the DEM, or nullptr; must outlive this object
    /// @param grid transform of the DEM @param name of the polygons in messages: "cutline 'area.shp'"
    RingProjector(OGRCoordinateTransformationH transform, const AffineTransform& grid, std::string name);

    /// Projects a ring and densifies edges that become curves, so that they deviate by less than a fiftieth
    /// of a cell. @throws InputError if a position has no image
    [[nodiscard]] WorldRing project(const WorldRing& ring) const;

  private:
    struct Vertex {
        Position source;
        Position pixel;
    };
    [[nodiscard]] Position to_pixel(Position source) const;
    void densify(const Vertex& from, const Vertex& to, int depth, WorldRing& ring) const;

    OGRCoordinateTransformationH transform_;
    AffineTransform to_cells_{};
    std::string name_;
};

/// Returns a lattice of positions over a part of a DEM and a margin around it, in the CRS of a layer. Not
/// only its rim, which would miss a pole inside. @param margin in cells @param to_layer transformation from
/// the CRS of the DEM; null if both are the same @return nothing if a position cannot be converted
[[nodiscard]] std::optional<WorldRing> lattice_over(const Window& part, double margin,
                                                    const AffineTransform& grid,
                                                    OGRCoordinateTransformationH to_layer);

/// Search extents of polygons, and the range of valid latitudes.
struct SearchExtents {
    std::vector<ClipBox> boxes;  ///< empty: unlimited
    ClipBox earth;               ///< latitudes between the poles
};

/// Returns the extents, in the CRS of the polygons, in which they can affect the window of a DEM: the window
/// and four times its size on all sides. Polygons farther away may have no image in the CRS of the DEM, or
/// one at an arbitrary position. For geographic CRSs, the same place is in several boxes, one turn apart.
/// @param polygons, dem coordinate reference systems, neither null
/// @return no boxes if they cannot be determined
[[nodiscard]] SearchExtents search_extents(OGRSpatialReferenceH polygons, OGRSpatialReferenceH dem,
                                           const DemInfo& info);

}  // namespace d2b::reading

#pragma once

#include <optional>

#include "core/crs.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// Point in pixels from the upper left corner of a map or page, y pointing down.
struct Spot {
    double x = 0;
    double y = 0;
};

/// Size of a map or page in pixels.
struct PixelSize {
    int width = 1;
    int height = 1;
};

/// Area shown by a picture.
struct MapGround {
    DemInfo dem;
    Crs crs;        ///< CRS of the DEM
    CellSize cell;  ///< metres, or units of the CRS if their length is unknown
};

/// Placement of a DEM's window in a picture, to scale on the ground. Rows and columns are parallel to the
/// sides. They start at the upper left, but are mirrored if y increases with rows or x decreases with
/// columns.
class MapFrame {
  public:
    MapFrame(MapGround ground, PixelSize size);

    [[nodiscard]] const MapGround& ground() const { return ground_; }
    [[nodiscard]] PixelSize size() const { return size_; }
    /// True if the first row is at the bottom.
    [[nodiscard]] bool bottom_up() const { return ground_.dem.transform[5] > 0; }
    /// True if the first column is on the right.
    [[nodiscard]] bool right_to_left() const { return ground_.dem.transform[1] < 0; }
    /// Returns the pixel size, in the units of MapGround::cell.
    [[nodiscard]] double metres_per_pixel() const;
    /// @param position in the CRS of the DEM
    [[nodiscard]] Spot spot(Position position) const;
    /// Returns the unit vector of the CRS's y axis; nullopt if the axis does not have to point north.
    [[nodiscard]] std::optional<Spot> north() const;

  private:
    MapGround ground_;
    PixelSize size_;
};

/// Rounds to at least one pixel.
[[nodiscard]] int whole_pixels(double length);

/// Returns width over height of a map.
[[nodiscard]] double aspect_of(const MapGround& ground);

}  // namespace d2b

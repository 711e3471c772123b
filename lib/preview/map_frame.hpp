#pragma once

#include <optional>

#include "core/crs.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b {

/// In pixels, from the upper left corner of a map or page, y down.
struct Spot {
    double x = 0;
    double y = 0;
};

/// Of a map or page, in pixels.
struct PixelSize {
    int width = 1;
    int height = 1;
};

/// The part of the earth that a picture shows.
struct MapGround {
    DemInfo dem;
    Crs crs;        ///< of the DEM
    CellSize cell;  ///< in metres, or in units of the CRS where nobody knows these in metres
};

/// How a DEM's window lies in a picture: its rows and columns run along the sides, from the upper left, or
/// where y grows with the rows or x against the columns from the other end; on the ground all is to scale.
class MapFrame {
  public:
    MapFrame(MapGround ground, PixelSize size);

    [[nodiscard]] const MapGround& ground() const { return ground_; }
    [[nodiscard]] PixelSize size() const { return size_; }
    /// Whether the first row lies at the bottom.
    [[nodiscard]] bool bottom_up() const { return ground_.dem.transform[5] > 0; }
    /// Whether the first column lies on the right.
    [[nodiscard]] bool right_to_left() const { return ground_.dem.transform[1] < 0; }
    /// Units of MapGround::cell.
    [[nodiscard]] double metres_per_pixel() const;
    /// @param position in the CRS of the DEM
    [[nodiscard]] Spot spot(Position position) const;
    /// Where the y axis of the CRS points to, of length 1; nothing where it need not be north.
    [[nodiscard]] std::optional<Spot> north() const;

  private:
    MapGround ground_;
    PixelSize size_;
};

/// At least one.
[[nodiscard]] int whole_pixels(double length);

/// Width of a map over its height.
[[nodiscard]] double aspect_of(const MapGround& ground);

}  // namespace d2b

#pragma once

#include "dem2buildings/dem_info.hpp"
#include "dem2buildings/feature_sink.hpp"
#include "preview/canvas.hpp"

namespace d2b {

/// How a DEM's window lies in a picture: its rows and columns run along the sides, from the upper left, or
/// where y grows with the rows or x against the columns from the other end; cells keep their shape.
class MapFrame {
  public:
    /// @param longest side of the picture, in pixels
    MapFrame(const DemInfo& dem, int longest);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// Whether the first row lies at the bottom.
    [[nodiscard]] bool bottom_up() const { return dem_.transform[5] > 0; }
    /// Whether the first column lies on the right.
    [[nodiscard]] bool right_to_left() const { return dem_.transform[1] < 0; }
    /// @param position in the CRS of the DEM
    [[nodiscard]] Spot spot(Position position) const;

  private:
    DemInfo dem_;
    int width_;
    int height_;
};

}  // namespace d2b

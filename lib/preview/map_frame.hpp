#pragma once

#include "core/dem_info.hpp"
#include "core/feature_sink.hpp"
#include "preview/canvas.hpp"

namespace d2b {

/// How a DEM's window lies in a picture: its rows and columns run along the sides, cells keep their shape.
class MapFrame {
  public:
    /// @param longest side of the picture, in pixels
    MapFrame(const DemInfo& dem, int longest);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// @param position in the CRS of the DEM
    [[nodiscard]] Spot spot(Position position) const;

  private:
    DemInfo dem_;
    int width_;
    int height_;
};

}  // namespace d2b

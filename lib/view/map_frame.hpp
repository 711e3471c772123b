#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/crs.hpp"
#include "core/grid.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b::view {

/// RGB, 8 bits per channel.
using Colour = std::array<std::uint8_t, 3>;

/// Blends two colours. @param opacity of the upper one
[[nodiscard]] inline Colour blend(Colour lower, Colour upper, double opacity) {
    Colour seen{};
    for (std::size_t i = 0; i < seen.size(); ++i)
        seen[i] = static_cast<std::uint8_t>(std::lround(lower[i] * (1 - opacity) + upper[i] * opacity));
    return seen;
}

inline constexpr Colour paper{255, 255, 255};
inline constexpr Colour ink{35, 35, 35};
inline constexpr Colour faint_ink{95, 95, 95};
/// Colour of outlines and frames.
inline constexpr Colour outline_colour{70, 45, 35};
/// Colour of differences between maps; not one of the height classes.
inline constexpr Colour difference_colour{0, 70, 200};
/// Colour of level ground in the relief.
inline constexpr Colour level_ground{222, 222, 222};
/// Opacity of footprints over the relief.
inline constexpr double footprint_opacity = 0.82;

/// Point in pixels from the upper left corner of a map or page, y pointing down.
struct PixelPoint {
    double x = 0;
    double y = 0;
};

/// Size of a map or page in pixels.
struct PixelSize {
    int width = 1;
    int height = 1;
};

/// Area shown by a picture.
struct MapArea {
    DemInfo dem;
    Crs crs;        ///< CRS of the DEM
    CellSize cell;  ///< metres, or units of the CRS if their length is unknown
};

/// Placement of a DEM's window in a picture, to scale on the ground. Rows and columns are parallel to the
/// sides. They start at the upper left, but are mirrored if y increases with rows or x decreases with
/// columns.
class MapFrame {
  public:
    MapFrame(MapArea area, PixelSize size);

    [[nodiscard]] const MapArea& area() const { return area_; }
    [[nodiscard]] PixelSize size() const { return size_; }
    /// True if the first row is at the bottom.
    [[nodiscard]] bool bottom_up() const { return area_.dem.transform[5] > 0; }
    /// True if the first column is on the right.
    [[nodiscard]] bool right_to_left() const { return area_.dem.transform[1] < 0; }
    /// Returns the pixel size, in the units of MapArea::cell.
    [[nodiscard]] double metres_per_pixel() const;
    /// @param position in the CRS of the DEM
    [[nodiscard]] PixelPoint pixel(Position position) const;
    /// Returns the unit vector of the CRS's y axis; nullopt if the axis does not have to point north.
    [[nodiscard]] std::optional<PixelPoint> north() const;

  private:
    MapArea area_;
    PixelSize size_;
};

/// Rounds to at least one pixel.
[[nodiscard]] int round_to_pixels(double length);

/// Returns width over height of a map.
[[nodiscard]] double aspect_ratio(const MapArea& area);

}  // namespace d2b::view

#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "read/cutline_polygons.hpp"
#include "read/gdal_handles.hpp"
#include "read/ring_clip.hpp"

namespace d2b {

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

}  // namespace d2b

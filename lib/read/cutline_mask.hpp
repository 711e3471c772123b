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

/// Which cell centres of a window lie inside of any of some polygons.
class CutlineMask {
  public:
    CutlineMask(const std::vector<PixelPolygon>& polygons, const Window& window);

    /// Whether the envelopes of the polygons and the window have anything in common.
    [[nodiscard]] bool meets_window() const { return !shapes_.empty(); }
    /// Sets to NaN what lies outside. Any thread may call it.
    /// @param part of the window @param elevations part.rows * part.cols values
    /// @throws InputError with GDAL's reason
    void apply(const Window& part, std::span<double> elevations);

  private:
    struct Shape {
        ClipBox box;  ///< around it; y is rows
        GeometryOwner geometry;
    };
    void burn(const Window& strip);

    Window window_;
    std::mutex burning_;
    std::vector<Shape> shapes_;
    Window strip_;                      ///< cells that are burnt
    std::vector<std::uint8_t> inside_;  ///< one a cell of these
};

/// The cutline that the options name, with a warning where it does not meet the window; null where they name
/// none. @throws InputError, OptionError as read_cutline()
[[nodiscard]] std::unique_ptr<CutlineMask> open_cutline(const ReadOptions& options, const DemInfo& info,
                                                        Warnings& warnings);

}  // namespace d2b

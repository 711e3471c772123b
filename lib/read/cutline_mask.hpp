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

namespace d2b {

/// Which cell centres of a window lie inside of any of some polygons.
class CutlineMask {
  public:
    CutlineMask(const std::vector<PixelPolygon>& polygons, const Window& window);

    /// Whether the envelopes of the polygons and the window have anything in common.
    [[nodiscard]] bool meets_window() const { return !geometries_.empty(); }
    /// Sets to NaN what lies outside. Any thread may call it. @param elevations rows * window.cols values
    /// from row first_row on
    /// @throws InputError with GDAL's reason
    void apply(std::int32_t first_row, std::int32_t rows, std::span<double> elevations);

  private:
    void burn(std::int32_t first_row);

    Window window_;
    std::mutex burning_;
    std::vector<GeometryOwner> geometries_;
    std::vector<std::uint8_t> strip_;  ///< strip_rows_ rows from strip_first_ on, 1 inside
    std::int32_t strip_first_ = 0;
    std::int32_t strip_rows_ = 0;
};

/// The cutline that the options name, with a warning where it does not meet the window; null where they name
/// none. @throws InputError, OptionError as read_cutline()
[[nodiscard]] std::unique_ptr<CutlineMask> open_cutline(const ReadOptions& options, const DemInfo& info,
                                                        Warnings& warnings);

}  // namespace d2b

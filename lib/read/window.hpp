#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"

namespace d2b {

/// Returns the part of a raster selected by the options: all of it, or one of source_window, projected_window
/// and extent. For an area in coordinates, cells whose centres lie inside are taken. A centre on the west or
/// south edge is inside and one on the east or north edge is outside, so that neighbouring windows share no
/// cell.
/// @param info rows, cols and transform of the whole raster
/// @throws OptionError if more than one window is given, or one that does not fit the raster
[[nodiscard]] Window choose_window(const ReadOptions& options, const DemInfo& info);

/// Returns a warning if an extent probably has QGIS order, in which both x come before both y; "" otherwise.
[[nodiscard]] std::string doubt_of_extent(const ReadOptions& options, const DemInfo& info);

/// Checks a part and its buffer. @param size of the buffer @throws InputError if the part does not lie inside
/// of the window or the buffer has another size
void require_part(const DemInfo& info, const Window& part, std::size_t size);

}  // namespace d2b

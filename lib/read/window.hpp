#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"

namespace d2b {

/// The part of a raster that the options ask for: all of it, or one of source_window, projected_window and
/// extent. Of an area in coordinates the cells whose centres lie inside are taken; a centre on the west or
/// south edge is inside and one on the east or north edge is not, so that neighbouring windows share no cell.
/// @param info rows, cols and transform of the whole raster
/// @throws OptionError more than one window, or one that does not fit the raster
[[nodiscard]] Window choose_window(const ReadOptions& options, const DemInfo& info);

/// A sentence where an extent is probably one of QGIS, in which both x come before both y; "" elsewhere.
[[nodiscard]] std::string doubt_of_extent(const ReadOptions& options, const DemInfo& info);

/// @param size of the buffer @throws InputError where the part does not lie inside of the window, or the
/// buffer has another size
void require_part(const DemInfo& info, const Window& part, std::size_t size);

}  // namespace d2b

#pragma once

#include <string>

#include "preview/map_picture.hpp"

namespace d2b {

/// Returns the size of the map on a page. @param longest side of the page
[[nodiscard]] PixelSize map_on_page(const MapGround& ground, int longest);

/// Draws a map with legend, scale bar, north arrow, number of buildings and source.
/// @param map has the size of map_on_page() @param parameters options that shaped the result
/// @param longest side of the page @return content of the file @throws OutputError
[[nodiscard]] std::string draw_map_page(const MapPicture& map, const std::string& tried, PictureFormat format,
                                        int longest);

}  // namespace d2b

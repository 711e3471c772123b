#pragma once

#include <string>

#include "preview/map_picture.hpp"

namespace d2b {

/// Of the map on a page. @param longest side of the page
[[nodiscard]] PixelSize map_on_page(const MapGround& ground, int longest);

/// A map with legend, scale bar, north arrow, what was found and where it comes from.
/// @param map of the size of map_on_page() @param tried the options that shaped the result
/// @param longest side of the page @return the file @throws OutputError
[[nodiscard]] std::string draw_map_page(const MapPicture& map, const std::string& tried, PictureFormat format,
                                        int longest);

}  // namespace d2b

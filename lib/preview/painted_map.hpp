#pragma once

#include "preview/cairo_handles.hpp"
#include "preview/map_picture.hpp"

namespace d2b {

/// Paints relief and footprints with a frame around them. @param place upper left corner @param font font
/// size of the page
void paint(const MapPicture& map, cairo_t* pen, Spot place, double font);

}  // namespace d2b

#pragma once

#include "preview/cairo_handles.hpp"
#include "preview/map_picture.hpp"

namespace d2b {

/// Relief, footprints and a frame around both. @param place upper left corner @param font size of letters
/// beside it
void paint(const MapPicture& map, cairo_t* pen, Spot place, double font);

}  // namespace d2b

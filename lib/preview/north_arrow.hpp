#pragma once

#include "preview/cairo_handles.hpp"
#include "preview/map_frame.hpp"

namespace d2b {

/// An arrow with an N at its tip. @param middle of the whole @param height of the whole
/// @param north where it points to, of length 1
void draw_north_arrow(cairo_t* pen, Spot middle, double height, Spot north);

}  // namespace d2b

#pragma once

#include "preview/cairo_handles.hpp"
#include "preview/map_frame.hpp"

namespace d2b {

/// Draws an arrow with an N at its tip. @param middle, height of both together
/// @param north direction as a unit vector
void draw_north_arrow(cairo_t* pen, Spot middle, double height, Spot north);

}  // namespace d2b

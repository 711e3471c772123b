#pragma once

#include <string>

#include "preview/cairo_handles.hpp"
#include "preview/map_frame.hpp"

namespace d2b {

/// Width of a legend, in font sizes.
inline constexpr double legend_width = 24;

/// Draws the height classes side by side in their colours on level ground, with the heights between them.
/// @param place upper left corner @param title meaning of the colours, with unit
void draw_legend(cairo_t* pen, Spot place, double font, const std::string& title);

}  // namespace d2b

#pragma once

#include <string>

#include "preview/cairo_handles.hpp"
#include "preview/map_frame.hpp"

namespace d2b {

/// Width of a legend, in sizes of letters.
inline constexpr double legend_width = 24;

/// The classes of height side by side, as their colours look on level ground, with the heights between them.
/// @param place upper left corner @param title what the colours say, with its unit
void draw_legend(cairo_t* pen, Spot place, double font, const std::string& title);

}  // namespace d2b

#pragma once

#include <string>

#include "preview/cairo_handles.hpp"
#include "preview/map_frame.hpp"

namespace d2b {

/// Round length of a scale bar.
struct ScaleLength {
    double metres = 1;  ///< 1, 2 or 5 times a power of ten
    int parts = 2;      ///< number of segments, each of a round length
};

/// Returns the longest round length up to a maximum.
[[nodiscard]] ScaleLength scale_length(double most_metres);
/// Returns text such as "200 m" or "5 km", or "200 units" if the metres are unknown.
[[nodiscard]] std::string length_text(double length, bool metres);

/// @param place upper left corner @param max_width of the bar including half of the last label
/// @param metres true if the units of the frame are metres
void draw_scale_bar(cairo_t* pen, Spot place, double room, double font, double metres_per_pixel, bool metres);

}  // namespace d2b

#pragma once

#include <string>

#include "preview/cairo_handles.hpp"
#include "preview/map_frame.hpp"

namespace d2b {

/// A length in round numbers.
struct ScaleLength {
    double metres = 1;  ///< 1, 2 or 5 times a power of ten
    int parts = 2;      ///< of the bar, each in round numbers
};

/// The longest that is not longer than so many metres.
[[nodiscard]] ScaleLength scale_length(double most_metres);
/// "200 m", "5 km"; "200 units" where nobody knows them in metres.
[[nodiscard]] std::string length_text(double length, bool metres);

/// @param place upper left corner @param room how long the bar may be, with half of its last label
/// @param metres whether the frame's units are metres
void draw_scale_bar(cairo_t* pen, Spot place, double room, double font, double metres_per_pixel, bool metres);

}  // namespace d2b

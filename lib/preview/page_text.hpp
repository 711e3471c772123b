#pragma once

#include <string>

#include "preview/cairo_handles.hpp"
#include "preview/map_frame.hpp"

namespace d2b {

enum class Align { left, middle, right };

struct TextStyle {
    double size = 12;  ///< of the letters, in pixels
    Colour colour = ink;
    bool bold = false;
    Align align = Align::left;
    double room = 0;  ///< what is wider loses its middle; 0: nothing is
};

/// From one line of small text to the next, in sizes of letters.
inline constexpr double line_spacing = 1.35;

/// A line of text in any script. @param place upper left corner of the line; of its middle or its right end
/// where it is aligned so @param text in UTF-8; other bytes show as such @throws OutputError
void draw_text(cairo_t* pen, Spot place, const TextStyle& style, const std::string& text);

}  // namespace d2b

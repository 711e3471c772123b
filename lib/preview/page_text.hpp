#pragma once

#include <string>

#include "preview/cairo_handles.hpp"
#include "preview/map_frame.hpp"

namespace d2b {

enum class Align { left, middle, right };

struct TextStyle {
    double size = 12;  ///< font size in pixels
    Colour colour = ink;
    bool bold = false;
    Align align = Align::left;
    double room = 0;  ///< maximum width, beyond which the middle is ellipsised; 0: unlimited
};

/// Distance between lines of small text, in font sizes.
inline constexpr double line_spacing = 1.35;

/// Draws a line of text in any script. @param place top of the line; left end, middle or right end, depending
/// on the alignment @param text in UTF-8; invalid bytes are shown as such @throws OutputError
void draw_text(cairo_t* pen, Spot place, const TextStyle& style, const std::string& text);

}  // namespace d2b

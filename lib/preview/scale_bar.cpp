#include "preview/scale_bar.hpp"

#include <cmath>

#include "core/number_text.hpp"
#include "preview/page_text.hpp"

namespace d2b {

ScaleLength scale_length(double most_metres) {
    const double power = std::pow(10, std::floor(std::log10(most_metres)));
    if (most_metres >= 5 * power)
        return {5 * power, 5};
    if (most_metres >= 2 * power)
        return {2 * power, 2};
    return {power, 2};
}

std::string length_text(double length, bool metres) {
    constexpr double kilometre = 1000;
    if (!metres)
        return number_text(length) + " units";
    return length < kilometre ? number_text(length) + " m" : number_text(length / kilometre) + " km";
}

void draw_scale_bar(cairo_t* pen, Spot place, double room, double font, double metres_per_pixel,
                    bool metres) {
    // Leaves space for half of a label on either side.
    const double aside = font * 1.6;
    const ScaleLength length = scale_length((room - 2 * aside) * metres_per_pixel);
    const double width = length.metres / metres_per_pixel;
    const double left = place.x + room - aside - width;
    const double height = font * 0.4;
    const double top = place.y + font * line_spacing;
    for (int part = 0; part < length.parts; ++part) {
        cairo_rectangle(pen, left + width * part / length.parts, top, width / length.parts, height);
        set_colour(pen, part % 2 == 0 ? ink : paper);
        cairo_fill(pen);
    }
    cairo_rectangle(pen, left, top, width, height);
    cairo_set_line_width(pen, font / 16);
    set_colour(pen, ink);
    cairo_stroke(pen);
    const TextStyle label{.size = font * 0.9, .align = Align::middle};
    draw_text(pen, {left, top + height * 1.5}, label, "0");
    draw_text(pen, {left + width, top + height * 1.5}, label, length_text(length.metres, metres));
}

}  // namespace d2b

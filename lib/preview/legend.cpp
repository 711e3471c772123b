#include "preview/legend.hpp"

#include <cstddef>

#include "core/height_classes.hpp"
#include "core/number_text.hpp"
#include "preview/page_text.hpp"

namespace d2b {

void draw_legend(cairo_t* pen, Spot place, double font, const std::string& title) {
    const auto classes = height_classes();
    const double width = legend_width * font / static_cast<double>(classes.size());
    const double top = place.y + font * line_spacing;
    const double height = font * 0.9;
    draw_text(pen, place, {.size = font, .room = legend_width * font}, title);
    for (std::size_t i = 0; i < classes.size(); ++i) {
        const double left = place.x + width * static_cast<double>(i);
        cairo_rectangle(pen, left, top, width, height);
        set_colour(pen, covered(level_ground, classes[i].colour, footprint_opacity));
        cairo_fill_preserve(pen);
        set_colour(pen, edge);
        cairo_set_line_width(pen, font / 20);
        cairo_stroke(pen);
        if (i > 0)
            draw_text(pen, {left, top + height + font * 0.1}, {.size = font * 0.9, .align = Align::middle},
                      number_text(classes[i].from));
    }
}

}  // namespace d2b

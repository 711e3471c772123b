#include "preview/north_arrow.hpp"

#include "preview/page_text.hpp"

namespace d2b {

void draw_north_arrow(cairo_t* pen, Spot middle, double height, Spot north) {
    const double letter = height * 0.4;
    const double half = height * 0.3;  // half of the arrow's length
    const double gap = height * 0.08;
    // The letter is upright beyond the tip. Arrow and letter are centred together.
    const auto along = [&](double by) { return Spot{middle.x + north.x * by, middle.y + north.y * by}; };
    const auto beside = [&](double by, double aside) {
        const Spot on = along(by);
        return Spot{on.x - north.y * aside, on.y + north.x * aside};
    };
    const double shift = -(letter + gap) / 2;
    const Spot tip = along(half + shift);
    const Spot notch = along(-half * 0.55 + shift);
    for (const double side : {-1.0, 1.0}) {
        const Spot foot = beside(-half + shift, side * half * 0.6);
        cairo_move_to(pen, tip.x, tip.y);
        cairo_line_to(pen, foot.x, foot.y);
        cairo_line_to(pen, notch.x, notch.y);
        cairo_close_path(pen);
        set_colour(pen, side < 0 ? ink : paper);
        cairo_fill_preserve(pen);
        set_colour(pen, ink);
        cairo_set_line_width(pen, height / 50);
        cairo_stroke(pen);
    }
    const Spot at = along(half + shift + gap + letter * 0.5);
    draw_text(pen, {at.x, at.y - letter * 0.62}, {.size = letter, .bold = true, .align = Align::middle}, "N");
}

}  // namespace d2b

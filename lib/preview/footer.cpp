#include "preview/footer.hpp"

#include <cstddef>

#include "preview/legend.hpp"
#include "preview/north_arrow.hpp"
#include "preview/page_text.hpp"
#include "preview/scale_bar.hpp"

namespace d2b {
namespace {

// Sizes below are in font sizes.
constexpr double block_height = 3.7;  // height of the legend and the blocks next to it
constexpr double scale_room = 13;
constexpr double arrow_room = 3.2;
constexpr double arrow_height = 3.2;

/// True if lengths on the ground are known in metres.
bool in_metres(const Crs& crs) {
    return crs.horizontal_unit().has_value() || crs.on_ellipsoid();
}

}  // namespace

Footer::Footer(double width, double font, int lines) : width_(width), font_(font), lines_(lines) {}

bool Footer::side_by_side() const {
    return width_ >= (legend_width + scale_room + arrow_room + 1) * font_;
}

double Footer::height() const {
    return ((side_by_side() ? 1 : 2) * block_height + lines_ * line_spacing) * font_;
}

double Footer::least_width(double font) {
    return legend_width * font;
}

void Footer::draw(cairo_t* pen, Spot place, const MapFrame& frame, const FooterText& text) const {
    draw_legend(pen, place, font_, text.legend);
    const double aside = place.y + (side_by_side() ? 0 : block_height * font_);
    const double right = place.x + (side_by_side() ? width_ : legend_width * font_);
    const std::optional<Spot> north = frame.north();
    const double arrow = north ? arrow_room * font_ : 0;
    draw_scale_bar(pen, {right - arrow - scale_room * font_, aside}, scale_room * font_, font_,
                   frame.metres_per_pixel(), in_metres(frame.ground().crs));
    if (north)
        draw_north_arrow(pen, {right - arrow_room * font_ / 2, aside + block_height * font_ * 0.45},
                         arrow_height * font_, *north);
    double y = place.y + height() - lines_ * line_spacing * font_;
    for (std::size_t i = 0; i < text.lines.size(); ++i) {
        const bool last = i + 1 == text.lines.size();
        draw_text(pen, {place.x, y},
                  {.size = last ? font_ * 0.85 : font_, .colour = last ? faint_ink : ink, .room = width_},
                  text.lines[i]);
        y += line_spacing * font_;
    }
}

}  // namespace d2b

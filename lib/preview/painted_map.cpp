#include "preview/painted_map.hpp"

#include "preview/footprint_surface.hpp"
#include "preview/relief_image.hpp"

namespace d2b {

void paint(const MapPicture& map, cairo_t* pen, Spot place, double font) {
    cairo_save(pen);
    cairo_translate(pen, place.x, place.y);
    paint(*map.relief, pen);
    paint(map.footprints, pen);
    cairo_rectangle(pen, 0, 0, map.frame.size().width, map.frame.size().height);
    set_colour(pen, faint_ink);
    cairo_set_line_width(pen, font / 16);
    cairo_stroke(pen);
    cairo_restore(pen);
}

}  // namespace d2b

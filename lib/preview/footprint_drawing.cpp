#include "preview/footprint_drawing.hpp"

#include <algorithm>

#include "preview/footprint_surface.hpp"

namespace d2b {
namespace {

SurfaceOwner make_surface(PixelSize size, PictureFormat format) {
    if (format == PictureFormat::png)
        return SurfaceOwner(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, size.width, size.height));
    const cairo_rectangle_t all{0, 0, static_cast<double>(size.width), static_cast<double>(size.height)};
    return SurfaceOwner(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &all));
}

/// Limits the line width, because small houses would otherwise be covered by their outlines.
double width_of_lines(const MapFrame& frame) {
    constexpr double ground_m = 0.7;
    return std::clamp(ground_m / frame.metres_per_pixel(), 0.25, 1.4);
}

void draw_rings(cairo_t* pen, FootprintDrawing::Rings rings) {
    for (const auto& ring : rings) {
        cairo_new_sub_path(pen);
        for (const Spot& spot : ring)
            cairo_line_to(pen, spot.x, spot.y);
        cairo_close_path(pen);
    }
}

}  // namespace

FootprintDrawing::FootprintDrawing(const MapFrame& frame, PictureFormat format)
    : impl_(std::make_unique<Impl>(
          Impl{frame.size(), width_of_lines(frame), make_surface(frame.size(), format), nullptr})) {
    impl_->pen.reset(cairo_create(impl_->surface.get()));
    cairo_t* pen = impl_->pen.get();
    check_drawn(cairo_status(pen));
    cairo_set_fill_rule(pen, CAIRO_FILL_RULE_EVEN_ODD);
    cairo_set_line_join(pen, CAIRO_LINE_JOIN_ROUND);
}
FootprintDrawing::FootprintDrawing(FootprintDrawing&&) noexcept = default;
FootprintDrawing& FootprintDrawing::operator=(FootprintDrawing&&) noexcept = default;
FootprintDrawing::~FootprintDrawing() = default;

void FootprintDrawing::fill(Rings rings, Colour colour) {
    cairo_t* pen = impl_->pen.get();
    draw_rings(pen, rings);
    set_colour(pen, colour);
    cairo_fill_preserve(pen);
    set_colour(pen, edge);
    cairo_set_line_width(pen, impl_->line_width);
    cairo_stroke(pen);
}

void FootprintDrawing::trace(Rings rings) {
    constexpr double faint = 0.5;
    cairo_t* pen = impl_->pen.get();
    draw_rings(pen, rings);
    set_colour(pen, edge, faint);
    cairo_set_line_width(pen, impl_->line_width * 0.7);
    cairo_stroke(pen);
}

void paint(const FootprintDrawing& footprints, cairo_t* pen) {
    const FootprintDrawing::Impl& of = footprints.impl();
    check_drawn(cairo_status(of.pen.get()));
    cairo_save(pen);
    cairo_rectangle(pen, 0, 0, of.size.width, of.size.height);
    cairo_clip(pen);
    cairo_set_source_surface(pen, of.surface.get(), 0, 0);
    cairo_paint_with_alpha(pen, footprint_opacity);
    cairo_restore(pen);
}

}  // namespace d2b

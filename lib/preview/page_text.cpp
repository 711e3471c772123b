#include "preview/page_text.hpp"

#include <algorithm>
#include <memory>

#include "preview/pango_calls.hpp"

namespace d2b {
namespace {

struct ObjectCloser {
    void operator()(gpointer object) const { g_object_unref(object); }
};
struct FontCloser {
    void operator()(PangoFontDescription* font) const { pango_font_description_free(font); }
};
struct OptionsCloser {
    void operator()(cairo_font_options_t* options) const { cairo_font_options_destroy(options); }
};
using LayoutOwner = std::unique_ptr<PangoLayout, ObjectCloser>;

/// Creates a layout independent of screen and locale, because a picture must not depend on the machine that
/// draws it.
LayoutOwner make_layout(cairo_t* pen) {
    const std::unique_ptr<PangoContext, ObjectCloser> context(pango_cairo_create_context(pen));
    const std::unique_ptr<cairo_font_options_t, OptionsCloser> options(cairo_font_options_create());
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    pango_cairo_context_set_font_options(context.get(), options.get());
    pango_context_set_language(context.get(), pango_language_from_string("en"));
    return LayoutOwner(pango_layout_new(context.get()));
}

std::string valid_utf8(const std::string& text) {
    struct Closer {
        void operator()(gchar* made) const { (g_free)(made); }  // bypasses the macro of newer versions
    };
    const std::unique_ptr<gchar, Closer> made(
        g_utf8_make_valid(text.data(), static_cast<gssize>(text.size())));
    return made.get();
}

}  // namespace

void draw_text(cairo_t* pen, Spot place, const TextStyle& style, const std::string& text) {
    const LayoutOwner layout = make_layout(pen);
    const std::unique_ptr<PangoFontDescription, FontCloser> font(pango_font_description_new());
    pango_font_description_set_family(font.get(), "DejaVu Sans,sans-serif");
    pango_font_description_set_weight(font.get(), style.bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_font_description_set_absolute_size(font.get(), style.size * PANGO_SCALE);
    pango_layout_set_font_description(layout.get(), font.get());
    pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
    const std::string valid = valid_utf8(text);
    pango_layout_set_text(layout.get(), valid.data(), static_cast<int>(valid.size()));
    // Keeps the sentence left-to-right even if it begins with a right-to-left name.
    pango_layout_set_auto_dir(layout.get(), FALSE);
    if (style.room > 0) {
        pango_layout_set_width(layout.get(), static_cast<int>(style.room * PANGO_SCALE));
        pango_layout_set_ellipsize(layout.get(), PANGO_ELLIPSIZE_MIDDLE);
    }
    PangoRectangle box{};
    pango_layout_get_extents(layout.get(), nullptr, &box);
    const double width = static_cast<double>(box.width) / PANGO_SCALE;
    const double left = style.align == Align::left     ? place.x
                        : style.align == Align::middle ? place.x - width / 2
                                                       : place.x - width;
    set_colour(pen, style.colour);
    cairo_move_to(pen, left, place.y);
    pango_cairo_show_layout(pen, layout.get());
    check_drawn(cairo_status(pen));
}

}  // namespace d2b

#pragma once

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <memory>
#include <pango/pangocairo.h>
#include <string>

#include "dem2buildings/error.hpp"
#include "view/map_frame.hpp"

namespace d2b::view {

/// Loads a library on first use and returns one of its functions.
/// @param library name for the dynamic linker @param function C name
/// @throws OutputError if the library or function does not exist
[[nodiscard]] void* load_symbol(const char* library, const char* function);

/// Declares a function of Cairo, Pango or GLib in namespace d2b, under its own name, that is resolved by the
/// first call. They are not linked because they pull in 26 libraries, by which every start would take 9 ms
/// longer although few runs draw. Loading pangocairo is enough, because it depends on all others.
// NOLINTNEXTLINE(cppcoreguidelines-macro-usage,bugprone-macro-parentheses): nothing else makes text of a name
#define D2B_LAZY_SYMBOL(function)                                                                      \
    inline constexpr auto function = [](auto... values) {                                              \
        static const auto loaded =                                                                     \
            reinterpret_cast<decltype(&::function)>(load_symbol("libpangocairo-1.0.so.0", #function)); \
        return loaded(values...);                                                                      \
    }

D2B_LAZY_SYMBOL(cairo_clip);
D2B_LAZY_SYMBOL(cairo_close_path);
D2B_LAZY_SYMBOL(cairo_create);
D2B_LAZY_SYMBOL(cairo_destroy);
D2B_LAZY_SYMBOL(cairo_fill);
D2B_LAZY_SYMBOL(cairo_fill_preserve);
D2B_LAZY_SYMBOL(cairo_font_options_create);
D2B_LAZY_SYMBOL(cairo_font_options_destroy);
D2B_LAZY_SYMBOL(cairo_font_options_set_antialias);
D2B_LAZY_SYMBOL(cairo_font_options_set_hint_metrics);
D2B_LAZY_SYMBOL(cairo_font_options_set_hint_style);
D2B_LAZY_SYMBOL(cairo_get_source);
D2B_LAZY_SYMBOL(cairo_get_target);
D2B_LAZY_SYMBOL(cairo_image_surface_create);
D2B_LAZY_SYMBOL(cairo_image_surface_get_data);
D2B_LAZY_SYMBOL(cairo_image_surface_get_stride);
D2B_LAZY_SYMBOL(cairo_line_to);
D2B_LAZY_SYMBOL(cairo_move_to);
D2B_LAZY_SYMBOL(cairo_new_sub_path);
D2B_LAZY_SYMBOL(cairo_paint);
D2B_LAZY_SYMBOL(cairo_paint_with_alpha);
D2B_LAZY_SYMBOL(cairo_pattern_set_extend);
D2B_LAZY_SYMBOL(cairo_pdf_surface_create_for_stream);
D2B_LAZY_SYMBOL(cairo_pdf_surface_restrict_to_version);
D2B_LAZY_SYMBOL(cairo_pdf_surface_set_metadata);
D2B_LAZY_SYMBOL(cairo_recording_surface_create);
D2B_LAZY_SYMBOL(cairo_rectangle);
D2B_LAZY_SYMBOL(cairo_restore);
D2B_LAZY_SYMBOL(cairo_save);
D2B_LAZY_SYMBOL(cairo_scale);
D2B_LAZY_SYMBOL(cairo_set_dash);
D2B_LAZY_SYMBOL(cairo_set_fill_rule);
D2B_LAZY_SYMBOL(cairo_set_line_join);
D2B_LAZY_SYMBOL(cairo_set_line_width);
D2B_LAZY_SYMBOL(cairo_set_source_rgba);
D2B_LAZY_SYMBOL(cairo_set_source_surface);
D2B_LAZY_SYMBOL(cairo_status);
D2B_LAZY_SYMBOL(cairo_status_to_string);
D2B_LAZY_SYMBOL(cairo_stroke);
D2B_LAZY_SYMBOL(cairo_surface_destroy);
D2B_LAZY_SYMBOL(cairo_surface_finish);
D2B_LAZY_SYMBOL(cairo_surface_flush);
D2B_LAZY_SYMBOL(cairo_surface_get_type);
D2B_LAZY_SYMBOL(cairo_surface_mark_dirty);
D2B_LAZY_SYMBOL(cairo_surface_set_device_scale);
D2B_LAZY_SYMBOL(cairo_surface_status);
D2B_LAZY_SYMBOL(cairo_surface_write_to_png_stream);
D2B_LAZY_SYMBOL(cairo_svg_surface_create_for_stream);
D2B_LAZY_SYMBOL(cairo_svg_surface_set_document_unit);
D2B_LAZY_SYMBOL(cairo_translate);

D2B_LAZY_SYMBOL(g_free);
D2B_LAZY_SYMBOL(g_object_unref);
D2B_LAZY_SYMBOL(g_utf8_make_valid);
D2B_LAZY_SYMBOL(pango_cairo_context_set_font_options);
D2B_LAZY_SYMBOL(pango_cairo_create_context);
D2B_LAZY_SYMBOL(pango_cairo_show_layout);
D2B_LAZY_SYMBOL(pango_context_set_language);
D2B_LAZY_SYMBOL(pango_font_description_free);
D2B_LAZY_SYMBOL(pango_font_description_new);
D2B_LAZY_SYMBOL(pango_font_description_set_absolute_size);
D2B_LAZY_SYMBOL(pango_font_description_set_family);
D2B_LAZY_SYMBOL(pango_font_description_set_weight);
D2B_LAZY_SYMBOL(pango_language_from_string);
D2B_LAZY_SYMBOL(pango_layout_get_extents);
D2B_LAZY_SYMBOL(pango_layout_new);
D2B_LAZY_SYMBOL(pango_layout_set_auto_dir);
D2B_LAZY_SYMBOL(pango_layout_set_ellipsize);
D2B_LAZY_SYMBOL(pango_layout_set_font_description);
D2B_LAZY_SYMBOL(pango_layout_set_single_paragraph_mode);
D2B_LAZY_SYMBOL(pango_layout_set_text);
D2B_LAZY_SYMBOL(pango_layout_set_width);

/// Releases an object by one of the functions above.
template <typename Function>
struct ReleaseBy {
    void operator()(auto* object) const { Function{}(object); }
};
using SurfacePtr = std::unique_ptr<cairo_surface_t, ReleaseBy<decltype(cairo_surface_destroy)>>;
/// Owns a drawing context.
using CairoPtr = std::unique_ptr<cairo_t, ReleaseBy<decltype(cairo_destroy)>>;

/// Checks a status. Once per drawing is enough, because Cairo keeps the first error and ignores later calls.
/// @throws OutputError on an error
inline void check_status(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw OutputError("The picture cannot be drawn (" + std::string(cairo_status_to_string(status)) +
                          "); give a smaller -preview_size or leave -preview out.");
}

inline void set_colour(cairo_t* pen, Colour colour, double opacity = 1) {
    constexpr double most = 255;
    cairo_set_source_rgba(pen, colour[0] / most, colour[1] / most, colour[2] / most, opacity);
}

}  // namespace d2b::view

#pragma once

#include <pango/pangocairo.h>

#include "preview/cairo_calls.hpp"

/// Functions of Pango and GLib used in this folder.
namespace d2b {

D2B_LATE_CALL(g_free);
D2B_LATE_CALL(g_object_unref);
D2B_LATE_CALL(g_utf8_make_valid);
D2B_LATE_CALL(pango_cairo_context_set_font_options);
D2B_LATE_CALL(pango_cairo_create_context);
D2B_LATE_CALL(pango_cairo_show_layout);
D2B_LATE_CALL(pango_context_set_language);
D2B_LATE_CALL(pango_font_description_free);
D2B_LATE_CALL(pango_font_description_new);
D2B_LATE_CALL(pango_font_description_set_absolute_size);
D2B_LATE_CALL(pango_font_description_set_family);
D2B_LATE_CALL(pango_font_description_set_weight);
D2B_LATE_CALL(pango_language_from_string);
D2B_LATE_CALL(pango_layout_get_extents);
D2B_LATE_CALL(pango_layout_new);
D2B_LATE_CALL(pango_layout_set_auto_dir);
D2B_LATE_CALL(pango_layout_set_ellipsize);
D2B_LATE_CALL(pango_layout_set_font_description);
D2B_LATE_CALL(pango_layout_set_single_paragraph_mode);
D2B_LATE_CALL(pango_layout_set_text);
D2B_LATE_CALL(pango_layout_set_width);

}  // namespace d2b

#pragma once

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include "preview/late_call.hpp"

/// Functions of Cairo used in this folder.
namespace d2b {

D2B_LATE_CALL(cairo_clip);
D2B_LATE_CALL(cairo_close_path);
D2B_LATE_CALL(cairo_create);
D2B_LATE_CALL(cairo_destroy);
D2B_LATE_CALL(cairo_fill);
D2B_LATE_CALL(cairo_fill_preserve);
D2B_LATE_CALL(cairo_font_options_create);
D2B_LATE_CALL(cairo_font_options_destroy);
D2B_LATE_CALL(cairo_font_options_set_antialias);
D2B_LATE_CALL(cairo_font_options_set_hint_metrics);
D2B_LATE_CALL(cairo_font_options_set_hint_style);
D2B_LATE_CALL(cairo_get_source);
D2B_LATE_CALL(cairo_get_target);
D2B_LATE_CALL(cairo_image_surface_create);
D2B_LATE_CALL(cairo_image_surface_get_data);
D2B_LATE_CALL(cairo_image_surface_get_stride);
D2B_LATE_CALL(cairo_line_to);
D2B_LATE_CALL(cairo_move_to);
D2B_LATE_CALL(cairo_new_sub_path);
D2B_LATE_CALL(cairo_paint);
D2B_LATE_CALL(cairo_paint_with_alpha);
D2B_LATE_CALL(cairo_pattern_set_extend);
D2B_LATE_CALL(cairo_pdf_surface_create_for_stream);
D2B_LATE_CALL(cairo_pdf_surface_set_metadata);
D2B_LATE_CALL(cairo_recording_surface_create);
D2B_LATE_CALL(cairo_rectangle);
D2B_LATE_CALL(cairo_restore);
D2B_LATE_CALL(cairo_save);
D2B_LATE_CALL(cairo_scale);
D2B_LATE_CALL(cairo_set_fill_rule);
D2B_LATE_CALL(cairo_set_line_join);
D2B_LATE_CALL(cairo_set_line_width);
D2B_LATE_CALL(cairo_set_source_rgba);
D2B_LATE_CALL(cairo_set_source_surface);
D2B_LATE_CALL(cairo_status);
D2B_LATE_CALL(cairo_status_to_string);
D2B_LATE_CALL(cairo_stroke);
D2B_LATE_CALL(cairo_surface_destroy);
D2B_LATE_CALL(cairo_surface_finish);
D2B_LATE_CALL(cairo_surface_flush);
D2B_LATE_CALL(cairo_surface_get_type);
D2B_LATE_CALL(cairo_surface_mark_dirty);
D2B_LATE_CALL(cairo_surface_set_device_scale);
D2B_LATE_CALL(cairo_surface_status);
D2B_LATE_CALL(cairo_surface_write_to_png_stream);
D2B_LATE_CALL(cairo_svg_surface_create_for_stream);
D2B_LATE_CALL(cairo_svg_surface_set_document_unit);
D2B_LATE_CALL(cairo_translate);

}  // namespace d2b

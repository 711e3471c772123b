#include "view/page.hpp"

#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string_view>

#include "core/height_classes.hpp"
#include "core/text.hpp"

namespace d2b::view {

void paint(const MapPicture& map, cairo_t* pen, PixelPoint place, double font) {
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

namespace {

using LayoutPtr = std::unique_ptr<PangoLayout, ReleaseBy<decltype(g_object_unref)>>;

/// Creates a layout independent of screen and locale, because a picture must not depend on the machine that
/// draws it.
LayoutPtr make_layout(cairo_t* pen) {
    const std::unique_ptr<PangoContext, ReleaseBy<decltype(g_object_unref)>> context(
        pango_cairo_create_context(pen));
    const std::unique_ptr<cairo_font_options_t, ReleaseBy<decltype(cairo_font_options_destroy)>> options(
        cairo_font_options_create());
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    pango_cairo_context_set_font_options(context.get(), options.get());
    pango_context_set_language(context.get(), pango_language_from_string("en"));
    return LayoutPtr(pango_layout_new(context.get()));
}

std::string valid_utf8(const std::string& text) {
    const std::unique_ptr<gchar, ReleaseBy<decltype(g_free)>> made(
        g_utf8_make_valid(text.data(), static_cast<gssize>(text.size())));
    return made.get();
}

// Sizes below are in font sizes.
constexpr double legend_width = 24;
constexpr double block_height = 3.7;  // height of the legend and the blocks next to it
constexpr double scale_room = 13;
constexpr double arrow_room = 3.2;
constexpr double arrow_height = 3.2;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

constexpr double points_per_pixel = 0.75;

/// @param bytes must outlive the surface
SurfacePtr make_surface(PixelSize size, writing::PictureFormat format, std::string& bytes) {
    if (format == writing::PictureFormat::png)
        return SurfacePtr(cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height));
    if (format == writing::PictureFormat::svg) {
        SurfacePtr surface(cairo_svg_surface_create_for_stream(append, &bytes, size.width, size.height));
        cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
        return surface;
    }
    SurfacePtr surface(cairo_pdf_surface_create_for_stream(append, &bytes, size.width * points_per_pixel,
                                                           size.height * points_per_pixel));
    // Any reader and plotter takes this one; the newest that a Cairo writes differs between systems.
    cairo_pdf_surface_restrict_to_version(surface.get(), CAIRO_PDF_VERSION_1_4);
    cairo_surface_set_device_scale(surface.get(), points_per_pixel, points_per_pixel);
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
    return surface;
}

/// Renumbers the ids of surfaces, images and sources in an SVG, because Cairo counts them per process and
/// equal drawings would differ.
std::string renumber_svg_ids(const std::string& svg) {
    constexpr std::array<std::string_view, 6> names{"id=\"image", "#image",       "id=\"surface",
                                                    "#surface",   "id=\"source-", "#source-"};
    std::map<std::string, std::string> numbers;
    std::string text;
    text.reserve(svg.size());
    for (std::size_t at = 0; at < svg.size();) {
        std::string_view found;
        for (const std::string_view name : names)
            if (std::string_view(svg).substr(at, name.size()) == name)
                found = name;
        if (found.empty()) {
            text += svg[at++];
            continue;
        }
        text += found;
        at += found.size();
        std::string number;
        while (at < svg.size() && std::isdigit(static_cast<unsigned char>(svg[at])) != 0)
            number += svg[at++];
        text += numbers.emplace(number, std::to_string(numbers.size() + 1)).first->second;
    }
    return text;
}

}  // namespace

void draw_text(cairo_t* pen, PixelPoint place, const TextStyle& style, const std::string& text) {
    const LayoutPtr layout = make_layout(pen);
    const std::unique_ptr<PangoFontDescription, ReleaseBy<decltype(pango_font_description_free)>> font(
        pango_font_description_new());
    pango_font_description_set_family(font.get(), "DejaVu Sans,sans-serif");
    pango_font_description_set_weight(font.get(), style.bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_font_description_set_absolute_size(font.get(), style.size * PANGO_SCALE);
    pango_layout_set_font_description(layout.get(), font.get());
    pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
    const std::string valid = valid_utf8(text);
    pango_layout_set_text(layout.get(), valid.data(), static_cast<int>(valid.size()));
    // Keeps the sentence left-to-right even if it begins with a right-to-left name.
    pango_layout_set_auto_dir(layout.get(), FALSE);
    if (style.max_width > 0) {
        pango_layout_set_width(layout.get(), static_cast<int>(style.max_width * PANGO_SCALE));
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
    check_status(cairo_status(pen));
}

ScaleBarLength scale_length(double max_metres) {
    const double power = std::pow(10, std::floor(std::log10(max_metres)));
    if (max_metres >= 5 * power)
        return {5 * power, 5};
    if (max_metres >= 2 * power)
        return {2 * power, 2};
    return {power, 2};
}

std::string length_text(double length, bool metres) {
    constexpr double kilometre = 1000;
    if (!metres)
        return number_text(length) + " units";
    return length < kilometre ? number_text(length) + " m" : number_text(length / kilometre) + " km";
}

void draw_scale_bar(cairo_t* pen, PixelPoint place, double max_width, double font, double metres_per_pixel,
                    bool metres) {
    // Leaves space for half of a label on either side.
    const double aside = font * 1.6;
    const ScaleBarLength length = scale_length((max_width - 2 * aside) * metres_per_pixel);
    const double width = length.metres / metres_per_pixel;
    const double left = place.x + max_width - aside - width;
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

namespace {

/// Draws the height classes side by side in their colours on level ground, with the heights between them.
/// @param place upper left corner @param title meaning of the colours, with unit
void draw_legend(cairo_t* pen, PixelPoint place, double font, const std::string& title) {
    const auto classes = height_classes();
    const double width = legend_width * font / static_cast<double>(classes.size());
    const double top = place.y + font * line_spacing;
    const double height = font * 0.9;
    draw_text(pen, place, {.size = font, .max_width = legend_width * font}, title);
    for (std::size_t i = 0; i < classes.size(); ++i) {
        const double left = place.x + width * static_cast<double>(i);
        cairo_rectangle(pen, left, top, width, height);
        set_colour(pen, blend(level_ground, classes[i].colour, footprint_opacity));
        cairo_fill_preserve(pen);
        set_colour(pen, outline_colour);
        cairo_set_line_width(pen, font / 20);
        cairo_stroke(pen);
        if (i > 0)
            draw_text(pen, {left, top + height + font * 0.1}, {.size = font * 0.9, .align = Align::middle},
                      number_text(classes[i].from));
    }
}

/// Draws an arrow with an N at its tip. @param middle, height of both together
/// @param north direction as a unit vector
void draw_north_arrow(cairo_t* pen, PixelPoint middle, double height, PixelPoint north) {
    const double letter = height * 0.4;
    const double half = height * 0.3;  // half of the arrow's length
    const double gap = height * 0.08;
    // The letter is upright beyond the tip. Arrow and letter are centred together.
    const auto along = [&](double by) {
        return PixelPoint{middle.x + north.x * by, middle.y + north.y * by};
    };
    const auto beside = [&](double by, double aside) {
        const PixelPoint on = along(by);
        return PixelPoint{on.x - north.y * aside, on.y + north.x * aside};
    };
    const double shift = -(letter + gap) / 2;
    const PixelPoint tip = along(half + shift);
    const PixelPoint notch = along(-half * 0.55 + shift);
    for (const double side : {-1.0, 1.0}) {
        const PixelPoint foot = beside(-half + shift, side * half * 0.6);
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
    const PixelPoint at = along(half + shift + gap + letter * 0.5);
    draw_text(pen, {at.x, at.y - letter * 0.62}, {.size = letter, .bold = true, .align = Align::middle}, "N");
}

}  // namespace

bool in_metres(const Crs& crs) {
    return crs.horizontal_unit().has_value() || crs.on_ellipsoid();
}

Footer::Footer(double width, double font, int line_count) : width_(width), font_(font), lines_(line_count) {}

bool Footer::side_by_side() const {
    return width_ >= (legend_width + scale_room + arrow_room + 1) * font_;
}

double Footer::height() const {
    return ((side_by_side() ? 1 : 2) * block_height + lines_ * line_spacing) * font_;
}

double Footer::min_width(double font) {
    return legend_width * font;
}

void Footer::draw(cairo_t* pen, PixelPoint place, const MapFrame& frame, const FooterText& text) const {
    draw_legend(pen, place, font_, text.legend);
    const double aside = place.y + (side_by_side() ? 0 : block_height * font_);
    const double right = place.x + (side_by_side() ? width_ : legend_width * font_);
    const std::optional<PixelPoint> north = frame.north();
    const double arrow = north ? arrow_room * font_ : 0;
    draw_scale_bar(pen, {right - arrow - scale_room * font_, aside}, scale_room * font_, font_,
                   frame.metres_per_pixel(), in_metres(frame.area().crs));
    if (north)
        draw_north_arrow(pen, {right - arrow_room * font_ / 2, aside + block_height * font_ * 0.45},
                         arrow_height * font_, *north);
    double y = place.y + height() - lines_ * line_spacing * font_;
    for (std::size_t i = 0; i < text.lines.size(); ++i) {
        const bool last = i + 1 == text.lines.size();
        draw_text(
            pen, {place.x, y},
            {.size = last ? font_ * 0.85 : font_, .colour = last ? faint_ink : ink, .max_width = width_},
            text.lines[i]);
        y += line_spacing * font_;
    }
}

std::string draw_page(PixelSize size, writing::PictureFormat format,
                      const std::function<void(cairo_t* pen)>& draw) {
    std::string bytes;
    const SurfacePtr surface = make_surface(size, format, bytes);
    check_status(cairo_surface_status(surface.get()));
    {
        const CairoPtr pen(cairo_create(surface.get()));
        set_colour(pen.get(), paper);
        cairo_paint(pen.get());
        draw(pen.get());
        check_status(cairo_status(pen.get()));
    }
    if (format == writing::PictureFormat::png)
        check_status(cairo_surface_write_to_png_stream(surface.get(), append, &bytes));
    cairo_surface_finish(surface.get());
    check_status(cairo_surface_status(surface.get()));
    return format == writing::PictureFormat::svg ? renumber_svg_ids(bytes) : bytes;
}

}  // namespace d2b::view

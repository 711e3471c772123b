#include "view/map_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "view/page.hpp"

namespace d2b::view {

namespace {

SurfacePtr make_surface(PixelSize size, writing::PictureFormat format) {
    if (format == writing::PictureFormat::png)
        return SurfacePtr(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, size.width, size.height));
    const cairo_rectangle_t all{0, 0, static_cast<double>(size.width), static_cast<double>(size.height)};
    return SurfacePtr(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &all));
}

/// Limits the line width, because small houses would otherwise be covered by their outlines.
double width_of_lines(const MapFrame& frame) {
    constexpr double ground_m = 0.7;
    return std::clamp(ground_m / frame.metres_per_pixel(), 0.25, 1.4);
}

void draw_rings(cairo_t* pen, FootprintDrawing::Rings rings) {
    for (const auto& ring : rings) {
        cairo_new_sub_path(pen);
        for (const PixelPoint& pixel : ring)
            cairo_line_to(pen, pixel.x, pixel.y);
        cairo_close_path(pen);
    }
}

int cells_per_sample(const MapFrame& frame) {
    const Window& window = frame.area().dem.window;
    const double across = static_cast<double>(window.cols) / frame.size().width;
    const double down = static_cast<double>(window.rows) / frame.size().height;
    return std::max(1, static_cast<int>(std::lround(std::min(across, down))));
}

int relief_samples(std::int32_t cells, int step) {
    return static_cast<int>((std::int64_t{cells} + step - 1) / step);
}

/// Colour of cells without elevation: white. Pixels are 0xRRGGBB.
constexpr std::uint32_t nodata_pixel = 0xFFFFFF;

/// Lambertian hillshade with light from the upper left, 45 degrees above the horizon. Slopes are compressed
/// to less than 0.8, because walls and trees would otherwise be black; gentle slopes are almost unchanged.
/// @param right, down slope (rise over run) in that direction @return a pixel
std::uint32_t hillshade_pixel(double right, double down) {
    constexpr double dark = 130;
    constexpr double flat = level_ground[0];
    constexpr double bright = 250;
    constexpr double steepest = 0.8;
    constexpr double brightest = 1.7320508075688772;  // relative to level ground
    const double less = steepest / (steepest + std::hypot(right, down));
    right *= less;
    down *= less;
    const double light = (1 + right + down) / std::sqrt(1 + right * right + down * down);
    const double grey = light < 1 ? dark + (flat - dark) * std::max(light, 0.0)
                                  : flat + (bright - flat) * (light - 1) / (brightest - 1);
    const auto level = static_cast<std::uint32_t>(std::lround(std::clamp(grey, dark, bright)));
    return level << 16U | level << 8U | level;
}

double rise_between(double from, double to, double here) {
    return (std::isnan(to) ? here : to) - (std::isnan(from) ? here : from);
}

/// Wraps a name in Unicode's first strong isolate, because a right-to-left name would otherwise reorder the
/// text after it.
std::string isolated(const std::string& name) {
    const std::string both_begin_with = "\xE2\x81";
    return both_begin_with + '\xA8' + name + both_begin_with + '\xA9';
}

}  // namespace

FootprintDrawing::FootprintDrawing(const MapFrame& frame, writing::PictureFormat format)
    : impl_(std::make_unique<Impl>(
          Impl{frame.size(), width_of_lines(frame), make_surface(frame.size(), format), nullptr})) {
    impl_->pen.reset(cairo_create(impl_->surface.get()));
    cairo_t* pen = impl_->pen.get();
    check_status(cairo_status(pen));
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
    set_colour(pen, outline_colour);
    cairo_set_line_width(pen, impl_->line_width);
    cairo_stroke(pen);
}

void FootprintDrawing::stroke(Rings rings) {
    constexpr double faint = 0.5;
    cairo_t* pen = impl_->pen.get();
    draw_rings(pen, rings);
    set_colour(pen, outline_colour, faint);
    cairo_set_line_width(pen, impl_->line_width * 0.7);
    cairo_stroke(pen);
}

void FootprintDrawing::mark(Rings rings, bool missing) {
    constexpr std::array<double, 2> dash{4, 3};
    cairo_t* pen = impl_->pen.get();
    draw_rings(pen, rings);
    set_colour(pen, difference_colour);
    cairo_set_line_width(pen, std::max(1.5, impl_->line_width * 1.5));
    cairo_set_dash(pen, dash.data(), missing ? 2 : 0, 0);
    cairo_stroke(pen);
    cairo_set_dash(pen, dash.data(), 0, 0);
}

void paint(const FootprintDrawing& footprints, cairo_t* pen) {
    const FootprintDrawing::Impl& of = footprints.impl();
    check_status(cairo_status(of.pen.get()));
    cairo_save(pen);
    cairo_rectangle(pen, 0, 0, of.size.width, of.size.height);
    cairo_clip(pen);
    cairo_set_source_surface(pen, of.surface.get(), 0, 0);
    cairo_paint_with_alpha(pen, footprint_opacity);
    cairo_restore(pen);
}

Relief::Impl::Impl(const MapFrame& map)
    : frame(map),
      step(cells_per_sample(map)),
      cols(relief_samples(map.area().dem.window.cols, step)),
      rows(relief_samples(map.area().dem.window.rows, step)),
      sums(static_cast<std::size_t>(cols)),
      counts(static_cast<std::size_t>(cols)),
      image(cairo_image_surface_create(CAIRO_FORMAT_RGB24, cols, rows)) {
    check_status(cairo_surface_status(image.get()));
}

void Relief::Impl::add_row(std::span<const float> row) {
    for (std::size_t i = 0; i < row.size(); ++i)
        if (!std::isnan(row[i])) {
            sums[i / static_cast<std::size_t>(step)] += static_cast<double>(row[i]);
            counts[i / static_cast<std::size_t>(step)] += 1;
        }
    ++rows_read;
    if (rows_read % step == 0 || rows_read == frame.area().dem.window.rows)
        end_row();
}

void Relief::Impl::end_row() {
    std::vector<double> means(sums.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < means.size(); ++i)
        if (counts[i] > 0)
            means[i] = sums[i] / counts[i];
    std::ranges::fill(sums, 0);
    std::ranges::fill(counts, 0);
    if (here.empty())
        above = means;
    else
        shade_row(means);
    here = std::move(means);
    if (rows_read == frame.area().dem.window.rows)
        shade_row(std::vector(here));
}

void Relief::Impl::shade_row(const std::vector<double>& below) {
    const CellSize& cell = frame.area().cell;
    const double per_right = (frame.right_to_left() ? -0.5 : 0.5) / (cell.across * step);
    const double per_down = (frame.bottom_up() ? -0.5 : 0.5) / (cell.down * step);
    cairo_surface_flush(image.get());
    auto* pixels = reinterpret_cast<std::uint32_t*>(cairo_image_surface_get_data(image.get()) +
                                                    static_cast<std::ptrdiff_t>(rows_shaded) *
                                                        cairo_image_surface_get_stride(image.get()));
    for (std::size_t i = 0; i < here.size(); ++i) {
        const double left = here[i > 0 ? i - 1 : i];
        const double right = here[i + 1 < here.size() ? i + 1 : i];
        pixels[i] = std::isnan(here[i])
                        ? nodata_pixel
                        : hillshade_pixel(rise_between(left, right, here[i]) * per_right,
                                          rise_between(above[i], below[i], here[i]) * per_down);
    }
    cairo_surface_mark_dirty(image.get());
    ++rows_shaded;
    above = here;
}

Relief::Relief(const MapFrame& frame) : impl_(std::make_unique<Impl>(frame)) {}
Relief::~Relief() = default;

void Relief::write(const Window& rows, std::span<const float> values) {
    const auto cols = static_cast<std::size_t>(rows.cols);
    for (std::int32_t row = 0; row < rows.rows; ++row)
        impl_->add_row(values.subspan(static_cast<std::size_t>(row) * cols, cols));
}

void paint(const Relief& relief, cairo_t* pen) {
    const Relief::Impl& of = relief.impl();
    const auto [width, height] = of.frame.size();
    const Window& window = of.frame.area().dem.window;
    cairo_save(pen);
    cairo_rectangle(pen, 0, 0, width, height);
    cairo_clip(pen);
    cairo_translate(pen, of.frame.right_to_left() ? width : 0, of.frame.bottom_up() ? height : 0);
    cairo_scale(pen, of.frame.right_to_left() ? -1 : 1, of.frame.bottom_up() ? -1 : 1);
    cairo_scale(pen, static_cast<double>(width) * of.step / window.cols,
                static_cast<double>(height) * of.step / window.rows);
    cairo_set_source_surface(pen, of.image.get(), 0, 0);
    // Not for SVG and PDF, because the viewer decides how to interpolate their cells.
    if (cairo_surface_get_type(cairo_get_target(pen)) == CAIRO_SURFACE_TYPE_IMAGE)
        cairo_pattern_set_extend(cairo_get_source(pen), CAIRO_EXTEND_PAD);
    cairo_paint(pen);
    cairo_restore(pen);
}

std::string source_line(const MapArea& area) {
    const std::string& name = area.dem.name;
    const std::string crs = area.crs.name();
    return "Source: " + isolated(name.substr(name.find_last_of('/') + 1)) + " · " +
           (crs.empty() ? "CRS not known" : crs);
}

std::string grouped(std::int64_t number) {
    std::string digits = std::to_string(number);
    for (std::ptrdiff_t at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(static_cast<std::size_t>(at), ",");
    return digits;
}

std::string count_noun(std::int64_t number, const std::string& one) {
    return grouped(number) + " " + one + (number == 1 ? "" : "s");
}

std::string count_text(const PictureCounts& counts) {
    return count_noun(counts.number, counts.contours_only ? "contour" : "building");
}

std::string rounded_metres(double metres) {
    const auto tenths = std::llround(metres * 10);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " m";
}

}  // namespace d2b::view

#include "preview/relief.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "preview/hillshade.hpp"
#include "preview/relief_image.hpp"

namespace d2b {
namespace {

int cells_a_sample(const MapFrame& frame) {
    const Window& window = frame.ground().dem.window;
    const double across = static_cast<double>(window.cols) / frame.size().width;
    const double down = static_cast<double>(window.rows) / frame.size().height;
    return std::max(1, static_cast<int>(std::lround(std::min(across, down))));
}

int samples(std::int32_t cells, int step) {
    return static_cast<int>((std::int64_t{cells} + step - 1) / step);
}

double rise_between(double from, double to, double here) {
    return (std::isnan(to) ? here : to) - (std::isnan(from) ? here : from);
}

}  // namespace

Relief::Impl::Impl(const MapFrame& map)
    : frame(map),
      step(cells_a_sample(map)),
      cols(samples(map.ground().dem.window.cols, step)),
      rows(samples(map.ground().dem.window.rows, step)),
      sums(static_cast<std::size_t>(cols)),
      counts(static_cast<std::size_t>(cols)),
      image(cairo_image_surface_create(CAIRO_FORMAT_RGB24, cols, rows)) {
    check_drawn(cairo_surface_status(image.get()));
}

void Relief::Impl::gather(std::span<const float> row) {
    for (std::size_t i = 0; i < row.size(); ++i)
        if (!std::isnan(row[i])) {
            sums[i / static_cast<std::size_t>(step)] += static_cast<double>(row[i]);
            counts[i / static_cast<std::size_t>(step)] += 1;
        }
    ++gathered;
    if (gathered % step == 0 || gathered == frame.ground().dem.window.rows)
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
        shade(means);
    here = std::move(means);
    if (gathered == frame.ground().dem.window.rows)
        shade(std::vector(here));
}

void Relief::Impl::shade(const std::vector<double>& below) {
    const CellSize& cell = frame.ground().cell;
    const double per_right = (frame.right_to_left() ? -0.5 : 0.5) / (cell.across * step);
    const double per_down = (frame.bottom_up() ? -0.5 : 0.5) / (cell.down * step);
    cairo_surface_flush(image.get());
    auto* pixels = reinterpret_cast<std::uint32_t*>(cairo_image_surface_get_data(image.get()) +
                                                    static_cast<std::ptrdiff_t>(shaded) *
                                                        cairo_image_surface_get_stride(image.get()));
    for (std::size_t i = 0; i < here.size(); ++i) {
        const double left = here[i > 0 ? i - 1 : i];
        const double right = here[i + 1 < here.size() ? i + 1 : i];
        pixels[i] = std::isnan(here[i]) ? open_ground
                                        : shade_of(rise_between(left, right, here[i]) * per_right,
                                                   rise_between(above[i], below[i], here[i]) * per_down);
    }
    cairo_surface_mark_dirty(image.get());
    ++shaded;
    above = here;
}

Relief::Relief(const MapFrame& frame) : impl_(std::make_unique<Impl>(frame)) {}
Relief::~Relief() = default;

void Relief::write(const Window& rows, std::span<const float> values) {
    const auto cols = static_cast<std::size_t>(rows.cols);
    for (std::int32_t row = 0; row < rows.rows; ++row)
        impl_->gather(values.subspan(static_cast<std::size_t>(row) * cols, cols));
}

void paint(const Relief& relief, cairo_t* pen) {
    const Relief::Impl& of = relief.impl();
    const auto [width, height] = of.frame.size();
    const Window& window = of.frame.ground().dem.window;
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

}  // namespace d2b

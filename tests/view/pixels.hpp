#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "view/cairo.hpp"
#include "view/map_frame.hpp"

namespace d2b::test {

/// A picture as it is seen.
class Pixels {
  public:
    /// A drawing on white paper.
    Pixels(view::PixelSize size, const std::function<void(cairo_t* pen)>& draw)
        : surface_(view::cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height)) {
        const view::CairoPtr pen(view::cairo_create(surface_.get()));
        view::set_colour(pen.get(), view::paper);
        view::cairo_paint(pen.get());
        draw(pen.get());
    }
    explicit Pixels(std::string png) {
        struct Rest {
            std::string bytes;
            std::size_t at = 0;
        } rest{std::move(png)};
        const auto read = [](void* from, unsigned char* to, unsigned int length) {
            auto& of = *static_cast<Rest*>(from);
            if (of.bytes.size() - of.at < length)
                return CAIRO_STATUS_READ_ERROR;
            std::memcpy(to, of.bytes.data() + of.at, length);
            of.at += length;
            return CAIRO_STATUS_SUCCESS;
        };
        surface_.reset(cairo_image_surface_create_from_png_stream(read, &rest));
        EXPECT_EQ(view::cairo_surface_status(surface_.get()), CAIRO_STATUS_SUCCESS);
    }

    [[nodiscard]] int width() const { return cairo_image_surface_get_width(surface_.get()); }
    [[nodiscard]] int height() const { return cairo_image_surface_get_height(surface_.get()); }
    [[nodiscard]] view::Colour at(int x, int y) const {
        view::cairo_surface_flush(surface_.get());
        std::uint32_t pixel = 0;
        std::memcpy(
            &pixel,
            view::cairo_image_surface_get_data(surface_.get()) +
                static_cast<std::ptrdiff_t>(y) * view::cairo_image_surface_get_stride(surface_.get()) +
                std::ptrdiff_t{4} * x,
            sizeof pixel);
        return {static_cast<std::uint8_t>(pixel >> 16U), static_cast<std::uint8_t>(pixel >> 8U),
                static_cast<std::uint8_t>(pixel)};
    }
    /// Pixels of a box that are darker than half.
    [[nodiscard]] int dark(int left, int top, int right, int bottom) const {
        int count = 0;
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x)
                count += at(x, y)[1] < 128 ? 1 : 0;
        return count;
    }

  private:
    view::SurfacePtr surface_;
};

inline void expect_near(view::Colour one, view::Colour other, int tolerance = 3) {
    for (std::size_t i = 0; i < one.size(); ++i)
        EXPECT_NEAR(one[i], other[i], tolerance) << "band " << i;
}

}  // namespace d2b::test

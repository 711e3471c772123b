#include "preview/page.hpp"

#include <array>
#include <cctype>
#include <map>
#include <string_view>

namespace d2b {
namespace {

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

constexpr double points_a_pixel = 0.75;

/// @param bytes must outlive the surface
SurfaceOwner make_surface(PixelSize size, PictureFormat format, std::string& bytes) {
    if (format == PictureFormat::png)
        return SurfaceOwner(cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.width, size.height));
    if (format == PictureFormat::svg) {
        SurfaceOwner surface(cairo_svg_surface_create_for_stream(append, &bytes, size.width, size.height));
        cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
        return surface;
    }
    SurfaceOwner surface(cairo_pdf_surface_create_for_stream(append, &bytes, size.width * points_a_pixel,
                                                             size.height * points_a_pixel));
    cairo_surface_set_device_scale(surface.get(), points_a_pixel, points_a_pixel);
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
    return surface;
}

/// Renumbers the ids of surfaces, images and sources in an SVG, because Cairo counts them per process and
/// equal drawings would differ.
std::string with_own_numbers(const std::string& svg) {
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

std::string draw_page(PixelSize size, PictureFormat format, const std::function<void(cairo_t* pen)>& draw) {
    std::string bytes;
    const SurfaceOwner surface = make_surface(size, format, bytes);
    check_drawn(cairo_surface_status(surface.get()));
    {
        const PenOwner pen(cairo_create(surface.get()));
        set_colour(pen.get(), paper);
        cairo_paint(pen.get());
        draw(pen.get());
        check_drawn(cairo_status(pen.get()));
    }
    if (format == PictureFormat::png)
        check_drawn(cairo_surface_write_to_png_stream(surface.get(), append, &bytes));
    cairo_surface_finish(surface.get());
    check_drawn(cairo_surface_status(surface.get()));
    return format == PictureFormat::svg ? with_own_numbers(bytes) : bytes;
}

}  // namespace d2b

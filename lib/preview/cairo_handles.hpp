#pragma once

#include <memory>
#include <string>

#include "dem2buildings/error.hpp"
#include "preview/cairo_calls.hpp"
#include "preview/colour.hpp"

/// Cairo's objects with their owners; for the sources of this folder alone.
namespace d2b {

struct SurfaceCloser {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using SurfaceOwner = std::unique_ptr<cairo_surface_t, SurfaceCloser>;

struct PenCloser {
    void operator()(cairo_t* pen) const { cairo_destroy(pen); }
};
/// What draws on a surface.
using PenOwner = std::unique_ptr<cairo_t, PenCloser>;

/// Cairo goes on after an error and remembers the first. @throws OutputError where there was one
inline void check_drawn(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw OutputError("The picture cannot be drawn (" + std::string(cairo_status_to_string(status)) +
                          "); give a smaller -preview_size or leave -preview out.");
}

inline void set_colour(cairo_t* pen, Colour colour, double opacity = 1) {
    constexpr double most = 255;
    cairo_set_source_rgba(pen, colour[0] / most, colour[1] / most, colour[2] / most, opacity);
}

}  // namespace d2b

#pragma once

#include <memory>
#include <string>

#include "dem2buildings/error.hpp"
#include "preview/cairo_calls.hpp"
#include "preview/colour.hpp"

/// RAII wrappers of Cairo objects. Include only in sources of this folder.
namespace d2b {

struct SurfaceCloser {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using SurfaceOwner = std::unique_ptr<cairo_surface_t, SurfaceCloser>;

struct PenCloser {
    void operator()(cairo_t* pen) const { cairo_destroy(pen); }
};
/// Owns a drawing context.
using PenOwner = std::unique_ptr<cairo_t, PenCloser>;

/// Checks a status. Once per drawing is enough, because Cairo keeps the first error and ignores later calls.
/// @throws OutputError on an error
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

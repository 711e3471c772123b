#pragma once

#include "preview/cairo_handles.hpp"
#include "preview/footprint_drawing.hpp"

namespace d2b {

struct FootprintDrawing::Impl {
    PixelSize size;
    double line_width;
    SurfaceOwner surface;
    PenOwner pen;
};

/// Paints over the whole map, whose upper left corner is the origin of the pen.
void paint(const FootprintDrawing& footprints, cairo_t* pen);

}  // namespace d2b

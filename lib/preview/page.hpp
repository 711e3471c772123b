#pragma once

#include <functional>
#include <string>

#include "preview/cairo_handles.hpp"
#include "preview/map_frame.hpp"
#include "preview/picture_format.hpp"

namespace d2b {

/// Draws a picture on white paper and gives its file. The same drawing gives the same bytes: they hold no
/// date. A pixel of a PDF is a 96th of an inch.
/// @param draw with a pen whose units are pixels, from the upper left corner @throws OutputError
[[nodiscard]] std::string draw_page(PixelSize size, PictureFormat format,
                                    const std::function<void(cairo_t* pen)>& draw);

}  // namespace d2b

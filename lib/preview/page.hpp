#pragma once

#include <functional>
#include <string>

#include "preview/cairo_handles.hpp"
#include "preview/map_frame.hpp"
#include "preview/picture_format.hpp"

namespace d2b {

/// Draws a picture on white paper and returns the content of its file. Deterministic: the file has no date. A
/// pixel of a PDF is 1/96 inch.
/// @param draw gets a pen in pixel units, origin in the upper left corner @throws OutputError
[[nodiscard]] std::string draw_page(PixelSize size, PictureFormat format,
                                    const std::function<void(cairo_t* pen)>& draw);

}  // namespace d2b

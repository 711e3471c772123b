#pragma once

#include <memory>
#include <string>

#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"
#include "write/destination.hpp"
#include "write/vector/vector_format.hpp"

namespace d2b::writing {

/// Returns true for a drawing, which has entities on named layers instead of features with fields, so that
/// GDAL's driver accepts none of ours.
[[nodiscard]] inline bool is_drawing(const VectorFormat& format) {
    return format.name == "DXF";
}

/// Returns the name as a layer of a drawing may have it: bytes other than letters, digits, "$", "-" and "_"
/// become "_".
[[nodiscard]] std::string drawing_layer_name(const std::string& name);

/// Opens a DXF (AutoCAD R12, ASCII). Rings become closed polylines: of buildings at the elevation of their
/// ground, of contours at their threshold, of faces of roofs at the elevations of their corners. The height
/// of a building is a text on a layer of its own. @throws OptionError for options without an effect on a
/// drawing, or if the destination is another kind of file
[[nodiscard]] std::unique_ptr<FeatureSink> open_dxf_sink(const WriteOptions& options,
                                                         const VectorFormat& format,
                                                         const Destination& destination);

}  // namespace d2b::writing

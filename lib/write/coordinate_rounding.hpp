#pragma once

#include <optional>
#include <string>

#include "dem2buildings/sinks.hpp"
#include "write/ogr_call.hpp"
#include "write/rehearsal.hpp"

namespace d2b {

/// How a format rounds coordinates with the options and the configuration of a run: polygons are written in
/// memory, read back and compared, because each driver and each version of GDAL has rules of its own.
/// @return nothing where it keeps them in a way of its own: on a grid that is not decimal, or in another CRS
[[nodiscard]] std::optional<CoordinateRounding> coordinate_rounding(const Draft& draft, bool appends);

/// Reads what has been written, and warns of polygons that are not valid there.
void warn_of_invalid(const WriteTarget& target, const VectorFormat& format, const std::string& path);

}  // namespace d2b

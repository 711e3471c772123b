#pragma once

#include <optional>
#include <string>

#include "dem2buildings/sinks.hpp"
#include "write/ogr_call.hpp"
#include "write/rehearsal.hpp"

namespace d2b {

/// Finds out how a format rounds coordinates with the options and configuration of a run: writes polygons in
/// memory, reads them back and compares, because each driver and GDAL version has its own rules.
/// @return nothing if the format stores coordinates in another CRS or on a grid that is not decimal
[[nodiscard]] std::optional<CoordinateRounding> coordinate_rounding(const Draft& draft, bool appends);

/// Reads the result back and warns of polygons that are invalid after rounding.
void warn_of_invalid(const WriteTarget& target, const VectorFormat& format, const std::string& path);

}  // namespace d2b

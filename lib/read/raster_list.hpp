#pragma once

#include <string>
#include <vector>

namespace d2b {

/// Reads names of rasters, one per line as for gdalbuildvrt; empty lines are ignored.
/// @throws InputError if the file cannot be read or names no raster
[[nodiscard]] std::vector<std::string> listed_rasters(const std::string& list);

}  // namespace d2b

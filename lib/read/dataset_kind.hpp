#pragma once

#include <string>

namespace d2b::reading {

/// Returns true if GDAL opens a dataset that has layers with geometries. Otherwise it is a raster, or cannot
/// be opened, which open_dem() explains.
[[nodiscard]] bool is_vector_dataset(const std::string& path);

}  // namespace d2b::reading

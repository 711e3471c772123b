#pragma once

#include <string>

namespace d2b {

/// Advice about a source that does not open as a raster, as the end of a sentence that begins with "; ": it
/// is a point cloud, an archive (with the raster in it, if there is one) or a vector dataset. Returns "" if
/// its kind is unknown.
[[nodiscard]] std::string unopened_advice(const std::string& path);

/// Advice about a raster that cannot be read, likewise. @param driver GDAL's short name
[[nodiscard]] std::string unread_advice(const std::string& path, const std::string& driver);

/// Returns true if two file names were probably given in the wrong order: the first one does not exist or
/// holds vectors, and the second one is a raster.
[[nodiscard]] bool are_swapped(const std::string& source, const std::string& destination);

}  // namespace d2b

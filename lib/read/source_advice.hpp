#pragma once

#include <string>

namespace d2b {

/// What a user can do about a source that does not open as a raster, as the end of a sentence that begins
/// with
/// "; ": it is a cloud of points, an archive (with the raster in it, if there is one) or a vector dataset. ""
/// where nothing is known of it.
[[nodiscard]] std::string unopened_advice(const std::string& path);

/// What a user can do about a raster that cannot be read, likewise. @param driver GDAL's short name
[[nodiscard]] std::string unread_advice(const std::string& path, const std::string& driver);

/// Whether two file names were given in the wrong order: the first is not there, or holds vectors, and the
/// second is a raster.
[[nodiscard]] bool are_swapped(const std::string& source, const std::string& destination);

}  // namespace d2b

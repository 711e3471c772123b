#pragma once

#include <filesystem>
#include <string>

#include "write/new_layer.hpp"

namespace d2b {

/// Writes <layer>.qml next to a Shapefile, which QGIS uses as its style. Failures are ignored, because the
/// result is complete without it. @param path of the dataset, a .shp or a folder of them
void write_style_beside(const std::string& path, const NewLayer& layer);

/// True if the file is a style that we wrote and nobody has changed.
[[nodiscard]] bool is_our_style(const std::filesystem::path& file);

/// Keeps styles of the user next to the destination: if the result is a folder, they replace our styles in
/// it; if it is a single file, our styles are deleted. @param result dataset as written
/// @param destination .shp or folder that it will become @param replaces true if the destination exists and
/// is replaced, including our style
void keep_users_styles(const std::filesystem::path& result, const std::filesystem::path& destination,
                       bool replaces);

}  // namespace d2b

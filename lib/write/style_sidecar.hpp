#pragma once

#include <filesystem>
#include <string>

#include "write/new_layer.hpp"

namespace d2b {

/// Writes <layer>.qml beside a Shapefile, which QGIS takes for its style. What cannot be written is left out:
/// the result is whole without it. @param path of the dataset, a .shp or a folder of them
void write_style_beside(const std::string& path, const NewLayer& layer);

/// Whether the file is a style that we wrote and nobody has changed.
[[nodiscard]] bool is_our_style(const std::filesystem::path& file);

/// Styles that stand beside the destination and are the user's stay: they take the place of ours in the
/// folder of the result, or ours are removed there where single files are renamed.
/// @param result what was written @param destination the .shp or the folder that it will be
/// @param replaces whether it is there and goes, with our style of it
void keep_users_styles(const std::filesystem::path& result, const std::filesystem::path& destination,
                       bool replaces);

}  // namespace d2b

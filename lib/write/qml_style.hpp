#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// First line of our styles. QGIS does not keep it, so a style saved by a user is recognized as the user's.
inline constexpr std::string_view style_mark = "<!-- The default style of dem2buildings -->\n";

/// Returns the QML document by which QGIS (3.16 and later) shows a layer: symbols, labels, 3D solids and
/// field aliases. @param columns of the layer, one per field of the spec, because formats may have shortened
/// the names
[[nodiscard]] std::string qml_style(const LayerSpec& spec, const std::vector<std::string>& columns);

}  // namespace d2b

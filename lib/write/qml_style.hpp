#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// The first line of a style of ours. QGIS does not keep it: what a user saves is the user's.
inline constexpr std::string_view style_mark = "<!-- The default style of dem2buildings -->\n";

/// How QGIS (3.16 and later) is to show a layer, as a QML document: symbols, labels, solids for 3D, and the
/// names of fields for people.
/// @param columns of the layer, one a field of the spec: formats may have shortened their names
[[nodiscard]] std::string qml_style(const LayerSpec& spec, const std::vector<std::string>& columns);

}  // namespace d2b

#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/feature_sink.hpp"

namespace d2b {

/// Heights of one colour in the legend: from `from` m to the next class's, the last without end. Fixed, so
/// that maps of two cities, or of two runs, can be laid side by side.
struct HeightClass {
    double from;
    std::array<unsigned char, 3> colour;
};
[[nodiscard]] std::span<const HeightClass> height_classes();
/// "below 3 m", "3 to 6 m", "100 m and more"
[[nodiscard]] std::string class_label(std::size_t index);

/// The first line of a style of ours. QGIS does not keep it: what a user saves is the user's.
inline constexpr std::string_view style_mark = "<!-- The default style of dem2buildings -->\n";

/// How QGIS (3.16 and later) is to show a layer, as a QML document: symbols, labels, solids for 3D, and the
/// names of fields for people.
/// @param columns of the layer, one a field of the spec: formats may have shortened their names
[[nodiscard]] std::string qml_style(const LayerSpec& spec, const std::vector<std::string>& columns);

}  // namespace d2b

#pragma once

#include <array>
#include <string>
#include <vector>

#include "dem2buildings/sinks.hpp"

/// Internal parts of QML documents, used by qml_*.cpp only.
namespace d2b::qml {

/// Fields used by a style, as quoted columns in an expression of QGIS, escaped for XML; "" if the style does
/// not use the field.
struct Columns {
    std::string colour;
    std::string label;
    std::array<std::string, 2> labelled;
    std::string order;
    std::string certainty;
    std::string top;
    std::string bottom;
    std::string height;
    std::string min_height;
};

/// Returns the 2D renderer: coloured by height with a legend, or a single symbol.
[[nodiscard]] std::string renderer(const LayerSpec& spec, const Columns& columns);
/// Returns the labels for large map scales.
[[nodiscard]] std::string labeling(const LayerSpec& spec, const Columns& columns);
/// Returns solids in the colours of the 2D renderer. They stand at their elevations, independent of the
/// terrain of the scene.
[[nodiscard]] std::string renderer_3d(const LayerSpec& spec, const Columns& columns);

/// Returns for example "255,237,160,255".
[[nodiscard]] std::string colour_text(std::size_t height_class);
/// Returns an expression, escaped for XML, that is true if a height is in a class.
[[nodiscard]] std::string class_filter(std::size_t height_class, const std::string& height);
/// Returns a data-defined property of a symbol.
[[nodiscard]] std::string defined_property(const std::string& name, const std::string& expression);
/// Wraps data-defined properties in their element.
[[nodiscard]] std::string defined_properties(const std::string& element, const std::string& properties);

}  // namespace d2b::qml

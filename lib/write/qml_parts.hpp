#pragma once

#include <array>
#include <string>
#include <vector>

#include "dem2buildings/sinks.hpp"

/// What a QML document is made of; for the files qml_*.cpp alone.
namespace d2b::qml {

/// The fields that a style speaks of, as quoted columns of an expression of QGIS, escaped for XML; "" where
/// the style names none.
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

/// Colours the layer by height, in a legend that says so, or gives all of it one look.
[[nodiscard]] std::string renderer(const LayerSpec& spec, const Columns& columns);
/// What is written on the features, on maps of large scale.
[[nodiscard]] std::string labeling(const LayerSpec& spec, const Columns& columns);
/// Solids in the colours of the renderer. They stand at their elevations, whatever the terrain of the scene.
[[nodiscard]] std::string renderer_3d(const LayerSpec& spec, const Columns& columns);

/// "255,237,160,255"
[[nodiscard]] std::string colour_text(std::size_t height_class);
/// Whether a height is in a class, as an expression that is escaped for XML.
[[nodiscard]] std::string class_filter(std::size_t height_class, const std::string& height);
/// What takes the place of a property of a symbol, for each feature.
[[nodiscard]] std::string defined_property(const std::string& name, const std::string& expression);
/// Some of them.
[[nodiscard]] std::string defined_properties(const std::string& element, const std::string& properties);

}  // namespace d2b::qml

#pragma once

#include <string>
#include <vector>

#include "dem2buildings/feature_sink.hpp"

/// What a QML document is made of; for the files qml_*.cpp alone.
namespace d2b::qml {

/// The fields that a style speaks of, as quoted columns of an expression of QGIS, escaped for XML; "" where
/// the style names none.
struct Columns {
    std::string colour;
    std::string label;
    std::string order;
    std::string top;
    std::string height;
    std::string min_height;
};

/// Colours the layer by height, or gives all of it one look.
[[nodiscard]] std::string renderer(const Columns& columns);
/// What is written on the features, on maps of large scale.
[[nodiscard]] std::string labeling(const LayerSpec& spec, const Columns& columns);
/// Solids in the colours of the renderer. They stand at their elevations, whatever the terrain of the scene.
[[nodiscard]] std::string renderer_3d(const LayerSpec& spec, const Columns& columns);

/// "255,237,160,255"
[[nodiscard]] std::string colour_text(std::size_t height_class);

}  // namespace d2b::qml

#pragma once

#include <string>
#include <vector>

#include "core/warnings.hpp"
#include "dem2buildings/score.hpp"

namespace d2b {

/// Which layer, and which field of heights.
struct LayerChoice {
    std::string dataset{};
    std::string layer{};                  ///< must be there; "": the first of `defaults` that is
    std::vector<std::string> defaults{};  ///< where none of these is there, the first layer with geometries
    std::string height_field{};           ///< must be there; "": the first of `default_heights` that is
    std::vector<std::string> default_heights{};
};

/// Names of the layers that have geometries. @throws InputError: cannot be opened
[[nodiscard]] std::vector<std::string> layer_names(const std::string& dataset, Warnings& warnings);

/// Reads the polygons of a layer; curves become lines. Features without a geometry are left out, those with
/// another one than polygons are so with a warning.
/// @throws InputError: cannot be opened or read, no layer. @throws OptionError: no such layer or field
[[nodiscard]] PolygonLayer read_polygon_layer(const LayerChoice& choice, Warnings& warnings);

}  // namespace d2b

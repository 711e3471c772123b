#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/warnings.hpp"
#include "dem2buildings/feature_sink.hpp"

namespace d2b {

/// A feature with polygons.
struct PolygonFeature {
    std::vector<WorldPolygon> polygons;  ///< rings run as they ran in the file
    std::optional<double> height;        ///< of the field that was asked for; nothing where it is NULL
    bool open_ring = false;              ///< a ring did not end where it began; it is closed here
};

/// A layer of polygons, with all of it in memory.
struct PolygonLayer {
    std::string dataset;  ///< as the user gave it
    std::string name;
    std::string crs_wkt;       ///< WKT2:2019, empty where there is none
    std::string height_field;  ///< that was found; "" where there is none
    std::vector<PolygonFeature> features;
};

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

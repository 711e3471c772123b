#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/warnings.hpp"
#include "dem2buildings/score.hpp"
#include "read/polygon_layer.hpp"

namespace d2b::reading {

/// A field that is to be read.
struct WantedField {
    std::vector<std::string> names;  ///< the first that the layer has counts
    bool required = true;
};

/// Feature with polygons, the elevations of their vertices and the values of fields.
struct FieldFeature {
    PolygonFeature shape;
    std::vector<double> elevations;  ///< one per vertex, ring by ring in the order of the shape; 0 without
    std::vector<std::optional<std::string>> values;  ///< one per wanted field; nullopt for NULL or no field
};

struct FieldLayer {
    std::string dataset;
    std::string name;
    std::string crs_wkt;     ///< WKT2:2019; empty if there is none
    std::vector<bool> has;   ///< per wanted field: the layer has it
    bool elevations = true;  ///< all features have elevations; true also without features
    std::vector<FieldFeature> features;
};

/// Reads the polygons of a layer with fields; curves become lines. Features without a geometry are skipped
/// silently, those with another geometry than polygons with a warning.
/// @throws InputError: cannot be opened or read, no layer. @throws OptionError: no such layer, or no field
/// that is required
[[nodiscard]] FieldLayer read_field_layer(const LayerChoice& choice, std::span<const WantedField> wanted,
                                          Warnings& warnings);

}  // namespace d2b::reading

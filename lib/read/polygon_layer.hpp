#pragma once

#include <string>
#include <vector>

#include "core/warnings.hpp"
#include "dem2buildings/score.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b::reading {

/// Choice of a layer and its height field.
struct LayerChoice {
    std::string dataset{};
    std::string layer{};                  ///< must exist; "": first existing one of `defaults`
    std::vector<std::string> defaults{};  ///< if none of them exists, the first layer with geometries
    std::string height_field{};           ///< must exist; "": first existing one of `default_heights`
    std::vector<std::string> default_heights{};
};

/// Names of layers with geometries. @throws InputError: cannot be opened
[[nodiscard]] std::vector<std::string> layer_names(const std::string& dataset, Warnings& warnings);

/// Reads the polygons of a layer; curves become lines. Features without a geometry are skipped silently,
/// those with another geometry than polygons with a warning.
/// @throws InputError: cannot be opened or read, no layer. @throws OptionError: no such layer or field
[[nodiscard]] PolygonLayer read_polygon_layer(const LayerChoice& choice, Warnings& warnings);

/// Area in which a raster has data: polygons along the edges of its cells.
struct ValidCells {
    std::vector<WorldPolygon> polygons;  ///< disjoint; each may touch itself at points
    std::string crs_wkt;                 ///< WKT2:2019; empty if there is none
    WorldRing middle_cell;               ///< outline of a cell in the middle, whether it has data or not
};

/// Outlines the cells of the first band that are not NoData, masked out, transparent, NaN or infinite.
/// @param path any raster that GDAL opens @throws InputError as open_dem(), or if no cell is valid
[[nodiscard]] ValidCells valid_cells(const std::string& path, Warnings& warnings);

/// Returns true if GDAL opens a dataset that has layers with geometries. Otherwise it is a raster, or cannot
/// be opened, which open_dem() explains.
[[nodiscard]] bool is_vector_dataset(const std::string& path);

}  // namespace d2b::reading

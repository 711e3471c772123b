#pragma once

#include <string>
#include <vector>

#include "core/warnings.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Area in which a raster has data: polygons along the edges of its cells.
struct ValidCells {
    std::vector<WorldPolygon> polygons;  ///< disjoint; each may touch itself at points
    std::string crs_wkt;                 ///< WKT2:2019; empty if there is none
};

/// Outlines the cells of the first band that are not NoData, masked out, transparent, NaN or infinite.
/// @param path any raster that GDAL opens @throws InputError as open_dem(), or if no cell is valid
[[nodiscard]] ValidCells valid_cells(const std::string& path, Warnings& warnings);

}  // namespace d2b

#pragma once

#include <string>
#include <vector>

#include "core/warnings.hpp"
#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Where a raster has data: polygons along the edges of its cells.
struct ValidCells {
    std::vector<WorldPolygon> polygons;  ///< do not overlap; each may touch itself in points
    std::string crs_wkt;                 ///< WKT2:2019, empty where there is none
};

/// The cells of the first band that are not NoData, masked out, transparent, NaN or infinite.
/// @param path any raster that GDAL opens @throws InputError as open_dem, or no cell is valid
[[nodiscard]] ValidCells valid_cells(const std::string& path, Warnings& warnings);

}  // namespace d2b

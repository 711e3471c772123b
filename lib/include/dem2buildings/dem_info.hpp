#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "dem2buildings/window.hpp"

namespace d2b {

/// The six terms of GDAL's affine transform, from (column, row) to coordinates:
/// x = g[0] + column g[1] + row g[2], y = g[3] + column g[4] + row g[5]; (0, 0) is the outer corner of the
/// first cell. Rotated, south-up and non-square grids are all of this form.
using AffineTransform = std::array<double, 6>;

/// What is known of a DEM before its elevations are read. Plain values: the algorithm never sees a file.
struct DemInfo {
    std::string name;       ///< as the user gave it; for messages and provenance
    std::int32_t rows = 0;  ///< of the whole raster
    std::int32_t cols = 0;  ///< of the whole raster
    Window window;          ///< the part that is used; rows and columns stay those of the whole raster
    AffineTransform transform{0, 1, 0, 0, 0, -1};  ///< without georeferencing: pixels, y up
    bool georeferenced = false;
    std::string crs_wkt;  ///< WKT2:2019, empty where there is none
    std::string
        band_unit;      ///< the band's unit of elevation as stated, e.g. "metre", "US survey foot"; may be ""
    double scale = 1;   ///< elevation = value as stored * scale + offset
    double offset = 0;  ///< of the same
    /// The elevation that the file's own NoData value becomes, where an option says that it is none.
    std::optional<double> set_aside_nodata;
    std::string driver;      ///< short name of the format, for the report
    std::int32_t bands = 1;  ///< of the whole raster
    bool bytes = false;      ///< the band's values are whole numbers from 0 to 255
    std::int32_t block_rows =
        1;  ///< rows that are decoded together; bands that keep to multiples of it are read once
};

}  // namespace d2b

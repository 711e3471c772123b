#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "render.hpp"

namespace d2b::sample {

/// How a raster is stored.
struct RasterSpec {
    Grid grid;
    VerticalUnit unit;
    std::string crs;  ///< e.g. "EPSG:25832"
    std::optional<double> nodata;
    bool tiled = false;  ///< tiles of 256 x 256 cells; rows otherwise
};

/// Fills elevations of `rows` rows from `first_row` on.
using RowSource = std::function<void(std::int32_t first_row, std::int32_t rows, std::span<float> elevations)>;

/// Writes a GeoTIFF of Float32, compressed without loss, 256 rows at a time. Replaces a file of that name.
/// @throws OutputError
void write_raster(const std::string& path, const RasterSpec& spec, const RowSource& source);
/// Renders a scene into one.
void write_raster(const std::string& path, const RasterSpec& spec, const Scene& scene);

}  // namespace d2b::sample

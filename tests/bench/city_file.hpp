#pragma once

#include <string>

#include "city.hpp"

namespace d2b::bench {

/// Writes a city into a GeoTIFF as surveys deliver them: Float32, DEFLATE with the predictor for floating
/// point, tiles of 256 x 256 cells, NoData, a projected CRS. Streams; replaces a file of that name.
/// @throws OutputError
void write_city(const std::string& path, const CitySpec& spec, int threads);

}  // namespace d2b::bench

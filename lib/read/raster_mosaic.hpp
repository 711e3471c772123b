#pragma once

#include <array>
#include <string>
#include <vector>

namespace d2b::reading {

/// Reads names of rasters, one per line as for gdalbuildvrt; empty lines are ignored.
/// @throws InputError if the file cannot be read or names no raster
[[nodiscard]] std::vector<std::string> read_raster_list(const std::string& list);

/// Rectangle of cells: columns, then rows, as half-open ranges [begin, end).
using RasterBox = std::array<std::array<double, 2>, 2>;

/// Returns true if no two boxes overlap. @pre no box is empty
[[nodiscard]] bool are_disjoint(std::vector<RasterBox> boxes);

/// Writes a VRT of rasters on one grid. Later rasters cover earlier ones; cells without data in all rasters
/// are NoData.
/// @param path of the VRT, which is overwritten
/// @param band that will be read @throws InputError if a raster cannot be opened or is not on the grid of the
/// first one; OutputError if the VRT cannot be written
void build_mosaic(const std::string& path, const std::vector<std::string>& rasters, int band);

}  // namespace d2b::reading

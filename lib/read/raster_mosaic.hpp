#pragma once

#include <string>
#include <vector>

namespace d2b {

/// Writes a VRT of rasters on one grid. Later rasters cover earlier ones; cells without data in all rasters
/// are NoData.
/// @param path of the VRT, which is overwritten
/// @param band that will be read @throws InputError if a raster cannot be opened or is not on the grid of the
/// first one; OutputError if the VRT cannot be written
void build_mosaic(const std::string& path, const std::vector<std::string>& rasters, int band);

}  // namespace d2b

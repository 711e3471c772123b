#pragma once

#include <string>
#include <vector>

namespace d2b {

/// Makes a VRT of rasters on one grid, the later above the earlier ones where they overlap. What none of them
/// covers, and what is no data in all that cover it, is no data. @param path of the VRT, which is written
/// over
/// @param band that will be read @throws InputError a raster cannot be opened, or is not on the grid of the
/// first; OutputError the VRT cannot be written
void build_mosaic(const std::string& path, const std::vector<std::string>& rasters, int band);

}  // namespace d2b

#pragma once

#include <string>

#include "read/open_raster.hpp"

namespace d2b {

/// Refuses a raster whose header cannot be true, or not be followed, before anything of it is allocated or
/// read: a side of more than 2^30 cells, an ENVI file or a text grid shorter than its cells need, a TIFF with
/// a block that its bytes cannot fill. GDAL would take zeros for the cells that are missing, look for them
/// for hours, or ask for as much memory as such a block claims.
/// @param name for messages @throws InputError
void check_claims(const OpenRaster& raster, const std::string& name);

}  // namespace d2b

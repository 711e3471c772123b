#pragma once

#include <string>

#include "read/open_raster.hpp"

namespace d2b {

/// Rejects a raster with an impossible or unsupported header before anything is allocated or read: a side of
/// more than 2^30 cells, an ENVI file or text grid shorter than its cells need, a TIFF with a block larger
/// than its bytes can fill. GDAL itself would read missing cells as zeros, search for them for hours, or
/// allocate the claimed block.
/// @param name for messages @throws InputError
void check_claims(const OpenRaster& raster, const std::string& name);

}  // namespace d2b

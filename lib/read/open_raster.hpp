#pragma once

#include <string>

#include "core/warnings.hpp"
#include "dem2buildings/options.hpp"
#include "read/gdal_handles.hpp"

namespace d2b::reading {

struct OpenRaster {
    DatasetOwner dataset;
    GDALRasterBandH band = nullptr;  ///< owned by the dataset
};

/// Opens a raster for reading and picks the band.
/// @param path file that GDAL opens; messages name options.source instead
/// @throws OptionError: unknown format, an open option without "="
/// @throws InputError: cannot be opened, only sub-datasets, no such band, complex values, shorter than its
/// header says
[[nodiscard]] OpenRaster open_raster(const ReadOptions& options, const std::string& path, Warnings& warnings);

/// Opens the first band of a raster that accompanies the DEM. @param name for messages
/// @throws InputError as open_raster()
[[nodiscard]] OpenRaster open_first_band(const std::string& name, const std::string& path,
                                         Warnings& warnings);

}  // namespace d2b::reading

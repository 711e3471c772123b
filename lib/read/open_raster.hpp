#pragma once

#include <string>

#include "core/warnings.hpp"
#include "dem2buildings/dem_source.hpp"
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

/// Describes a raster by its size, its format, and the unit, scale, offset and NoData value of the band. The
/// window is all of it. @param name for messages
[[nodiscard]] DemInfo describe_raster(const OpenRaster& raster, const std::string& name);

/// Opens the first band of a raster that accompanies the DEM. @param name for messages
/// @throws InputError as open_raster()
[[nodiscard]] OpenRaster open_first_band(const std::string& name, const std::string& path,
                                         Warnings& warnings);

}  // namespace d2b::reading

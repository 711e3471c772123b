#pragma once

#include <string>
#include <vector>

#include "dem2buildings/options.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// OGR driver that can create layers, and properties of its datasets at one destination.
struct VectorFormat {
    GDALDriverH driver = nullptr;
    std::string name;             ///< short name, e.g. "GPKG"
    bool several_layers = false;  ///< a dataset at this destination can hold both of our layers
    bool transactions = false;    ///< native transactions, not emulated by copies
    bool keeps_crs = true;
    bool folder = false;                ///< a dataset at this destination is a folder of files
    std::vector<std::string> suffixes;  ///< suffixes of the files of a dataset here, from the first dot on
};

/// Selects a format by -f, or by the extension or prefix of the destination; the first registered driver,
/// like ogr2ogr. @throws OptionError listing usable formats; also for vector tiles, because they do not
/// preserve geometries
[[nodiscard]] VectorFormat format_for(const WriteOptions& options);

/// Opens a dataset with this driver only. @param access GDAL_OF_READONLY or GDAL_OF_UPDATE @return null on
/// failure
DatasetOwner open_dataset(const VectorFormat& format, const std::string& path, unsigned access);

/// True if the destination is a pipe or a device, which is written sequentially and cannot be read back.
[[nodiscard]] bool is_stream(const std::string& destination);

/// True if the driver takes the destination for a connection to a database or service, e.g. "PG:dbname=city".
[[nodiscard]] bool is_connection(GDALDriverH driver, const std::string& destination);

/// True if the driver supports virtual file systems of GDAL.
[[nodiscard]] bool keeps_virtual_files(GDALDriverH driver);

/// True if the driver has a layer creation option of this name.
[[nodiscard]] bool has_layer_option(GDALDriverH driver, const std::string& name);

}  // namespace d2b

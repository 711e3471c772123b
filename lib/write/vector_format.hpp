#pragma once

#include <string>
#include <vector>

#include "dem2buildings/options.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// An OGR driver that can create layers, and what its datasets are like at one destination.
struct VectorFormat {
    GDALDriverH driver = nullptr;
    std::string name;             ///< short name, e.g. "GPKG"
    bool several_layers = false;  ///< a dataset at this destination can hold both of our layers
    bool transactions = false;    ///< of the format's own, not emulated by copies
    bool keeps_crs = true;
    bool folder = false;  ///< a dataset at this destination is a folder of files
    std::vector<std::string>
        suffixes;  ///< of the files of a dataset here, from the first dot of their names on
};

/// By -f, or by the destination's extension or prefix; the first driver registered for it, as ogr2ogr does.
/// @throws OptionError naming formats that can be used; also for tiles, which give nothing back as it was
[[nodiscard]] VectorFormat format_for(const WriteOptions& options);

/// By this driver alone. @param access GDAL_OF_READONLY or GDAL_OF_UPDATE @return null where it cannot
DatasetOwner open_dataset(const VectorFormat& format, const std::string& path, unsigned access);

/// Whether the destination is a pipe or a device: written once, from front to back, and never read again.
[[nodiscard]] bool is_stream(const std::string& destination);

/// Whether the driver takes the destination for the name of a database or a service, e.g. "PG:dbname=city".
[[nodiscard]] bool is_connection(GDALDriverH driver, const std::string& destination);

/// Whether the driver reads and writes through GDAL's virtual files.
[[nodiscard]] bool keeps_virtual_files(GDALDriverH driver);

/// Whether the driver has a layer creation option of this name.
[[nodiscard]] bool has_layer_option(GDALDriverH driver, const std::string& name);

}  // namespace d2b

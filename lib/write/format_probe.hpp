#pragma once

#include <string>
#include <vector>

#include <gdal.h>

namespace d2b {

/// Properties of a format found by a trial, because metadata of drivers are unreliable.
struct FormatProbe {
    bool several_layers = false;
    bool transactions = false;
    bool keeps_crs = true;
    bool folder = false;
    std::vector<std::string> suffixes;  ///< suffixes of its files from the first dot on; empty for a folder
};

/// Writes two layers with one feature each into /vsimem/ under a name with the extension of the destination,
/// and inspects the result. Capabilities are not enough, because the Shapefile, CSV and FlatGeobuf drivers
/// hold several layers in a folder but one in a file, and some accept a second layer and put it elsewhere.
/// GeoPackage is not tried, because its properties are known.
[[nodiscard]] FormatProbe probe_format(GDALDriverH driver, const std::string& destination);

}  // namespace d2b

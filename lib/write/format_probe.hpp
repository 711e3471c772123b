#pragma once

#include <string>
#include <vector>

#include <gdal.h>

namespace d2b {

/// What a format turns out to do, whatever its driver says of itself.
struct FormatProbe {
    bool several_layers = false;
    bool transactions = false;
    bool keeps_crs = true;
    bool folder = false;
    std::vector<std::string> suffixes;  ///< of its files, from the first dot on; none for a folder
};

/// Writes two layers of one feature into /vsimem/ under a name with the destination's extension, and looks
/// what became of them. Capabilities do not tell: the Shapefile, CSV and FlatGeobuf drivers hold several
/// layers in a folder and one in a file, and some of them say yes to a second layer and put it elsewhere.
/// GeoPackage is known.
[[nodiscard]] FormatProbe probe_format(GDALDriverH driver, const std::string& destination);

}  // namespace d2b

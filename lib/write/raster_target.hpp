#pragma once

#include <map>
#include <string>
#include <vector>

namespace d2b {

/// What a file beside the layers is.
enum class RasterFormat { geotiff, picture, surface, materials, page };

/// Where a raster is to go.
struct RasterTarget {
    /// A file name that ends in .tif or .tiff, in .png, .svg or .pdf, .html, .mtl, or as surface_format_of()
    /// knows it.
    std::string destination;
    bool overwrite = false;
    std::vector<std::string> in_use;  ///< names of what else the run reads and writes
    RasterFormat format = RasterFormat::geotiff;
};

/// What a raster says of itself.
struct RasterMeta {
    std::string unit = "metre";
    std::string description;                      ///< of the band
    std::map<std::string, std::string> metadata;  ///< of the dataset
    /// Values are above what the vertical part of the CRS names, which is then kept where its unit is the
    /// metre; else it is left out, since it would be wrong.
    bool elevations = false;
};

/// A destination that can be written.
struct RasterPlace {
    std::string name;                    ///< as the user gave it; for messages
    std::string path;                    ///< without symbolic links
    bool local = false;                  ///< a file of this machine, not one of GDAL's virtual ones
    std::vector<std::string> old_files;  ///< what is replaced: the file and those that GDAL reads with it
    std::string stamp;                   ///< of old_files; changes when they do
};

/// @throws OptionError: not a name of the format, in use, exists without overwrite or is something else,
/// files in the way. @throws OutputError: no such folder, not writable
[[nodiscard]] RasterPlace locate_raster(const RasterTarget& target);

}  // namespace d2b

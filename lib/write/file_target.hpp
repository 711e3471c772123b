#pragma once

#include <map>
#include <string>
#include <vector>

namespace d2b {

/// Kinds of files written next to the layers.
enum class FileKind { geotiff, picture, surface, materials, page };

/// Requested destination of a raster or other file.
struct FileTarget {
    /// File name that ends in .tif or .tiff, in .png, .svg or .pdf, .html, .mtl, or in an extension known to
    /// surface_format_of().
    std::string destination;
    bool overwrite = false;
    std::vector<std::string> in_use;  ///< names of the other files that the run reads and writes
    FileKind format = FileKind::geotiff;
};

/// Metadata of a raster.
struct RasterMetadata {
    std::string unit = "metre";
    std::string description;                      ///< description of the band
    std::map<std::string, std::string> metadata;  ///< metadata of the dataset
    /// True if values refer to the vertical part of the CRS. It is kept if its unit is the metre, otherwise
    /// left out because it would be wrong.
    bool elevations = false;
};

/// Checked, writable destination.
struct FileDestination {
    std::string name;                    ///< user input, for messages
    std::string path;                    ///< without symbolic links
    bool local = false;                  ///< local file, not one of a virtual file system of GDAL
    std::vector<std::string> old_files;  ///< files to replace: the file and its sidecar files
    std::string stamp;                   ///< changes when old_files change
};

/// @throws OptionError if the name does not match the format, is in use, exists without overwrite or is
/// another kind of file, or sidecar files are in the way @throws OutputError if the folder does not exist or
/// is not writable
[[nodiscard]] FileDestination resolve_file_target(const FileTarget& target);

}  // namespace d2b

#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "write/staging.hpp"

namespace d2b::writing {

/// Kinds of files written next to the layers.
enum class FileKind { geotiff, picture, surface, materials, page };

enum class PictureFormat { png, svg, pdf };

/// Returns the format for the extension of a file name; not case-sensitive.
[[nodiscard]] std::optional<PictureFormat> picture_format_of(const std::string& name);

/// True if a file with this beginning is a picture in one of these formats.
[[nodiscard]] bool begins_a_picture(const std::string& beginning);

/// Marker at the begin of our pages, so that no other HTML file is replaced.
inline constexpr std::string_view page_signature = "<!DOCTYPE html>\n<!-- A page of dem2buildings -->\n";

/// True if a file begins like one of our pages.
[[nodiscard]] inline bool looks_like_page(std::string_view beginning) {
    return beginning.starts_with(page_signature);
}

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
    std::string name;    ///< user input, for messages
    std::string path;    ///< without symbolic links
    bool local = false;  ///< local file, not one of a virtual file system of GDAL
    ReplacedFiles old;   ///< the file and its sidecar files
};

/// @throws OptionError if the name does not match the format, is in use, exists without overwrite or is
/// another kind of file, or sidecar files are in the way @throws OutputError if the folder does not exist or
/// is not writable
[[nodiscard]] FileDestination resolve_file_target(const FileTarget& target);

}  // namespace d2b::writing

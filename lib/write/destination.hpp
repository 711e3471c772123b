#pragma once

#include <string>
#include <vector>

#include "dem2buildings/options.hpp"
#include "write/vector_format.hpp"

namespace d2b {

/// Destination of the result.
struct Destination {
    std::string name;     ///< user input without a password; for messages
    std::string path;     ///< without symbolic links and trailing slash
    bool local = false;   ///< local file or folder: staged, then renamed
    bool exists = false;  ///< false for an empty folder if the format creates a folder
};

/// Also used for rasters. @throws OptionError for names in archives and in read-only file systems
void refuse_archive(const std::string& name);

/// Finds out if the destination exists and can be written. @throws OptionError if -overwrite and -append are
/// both given, it exists and neither is given, it is a folder instead of a file, or other files are in the
/// way @throws OutputError if its folder does not exist or it is not writable
[[nodiscard]] Destination locate(const WriteOptions& options, const VectorFormat& format);

}  // namespace d2b

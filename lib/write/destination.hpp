#pragma once

#include <string>
#include <vector>

#include "dem2buildings/options.hpp"
#include "write/vector_format.hpp"

namespace d2b {

/// Where the result goes.
struct Destination {
    std::string name;     ///< as the user gave it, without a password; for messages
    std::string path;     ///< without symbolic links and a slash at the end
    bool local = false;   ///< a file or folder of this machine: written beside, then renamed
    bool exists = false;  ///< an empty folder does not count where the format makes a folder
};

/// For rasters as well. @throws OptionError: in an archive, or at a place that is only read
void refuse_archive(const std::string& name);

/// Looks at the destination and whether it can be written. @throws OptionError: -overwrite with -append,
/// exists without either, a folder where a file is meant, files in the way. @throws OutputError: no such
/// folder, not writable
[[nodiscard]] Destination locate(const WriteOptions& options, const VectorFormat& format);

}  // namespace d2b

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "write/file_target.hpp"

namespace d2b {
class CommitList;
}

namespace d2b::writing {

/// Image file that appears whole or not at all, like a GeoTIFF of open_geotiff_sink().
class PictureFile {
  public:
    PictureFile() = default;
    PictureFile(const PictureFile&) = delete;
    PictureFile& operator=(const PictureFile&) = delete;
    virtual ~PictureFile() = default;

    /// Format by file extension.
    [[nodiscard]] virtual PictureFormat format() const = 0;
    /// Writes the file under a temporary name. @param bytes of the whole file @throws OutputError
    virtual void write(const std::string& bytes) = 0;
    /// Adds it to a commit. @param commit publishes it during the lifetime of this object @throws OutputError
    virtual void prepare(CommitList& commit) = 0;
    /// Returns the warnings since the last call, one sentence each.
    [[nodiscard]] virtual std::vector<std::string> take_warnings() = 0;
};

/// Makes all checks that need no image. @throws OptionError, OutputError like resolve_file_target()
[[nodiscard]] std::unique_ptr<PictureFile> open_picture(const FileTarget& target);

}  // namespace d2b::writing

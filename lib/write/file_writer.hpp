#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dem2buildings/commit_list.hpp"
#include "write/file_target.hpp"

namespace d2b::writing {

/// Writes a file in pieces under a temporary name; a CommitList publishes it, like a GeoTIFF of
/// open_geotiff_sink(). Until then the destination is unchanged. A sink that writes two files has two of
/// these; dem2buildings/commit_list.hpp defines the order in which it prepares them.
class FileWriter {
  public:
    explicit FileWriter(FileDestination place);
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;
    ~FileWriter();

    /// Name for messages.
    [[nodiscard]] const std::string& name() const;
    /// True if an old file exists.
    [[nodiscard]] bool replaces() const;
    /// Appends bytes. @throws OutputError
    void write(std::string_view bytes);
    /// Completes the file and adds it to a commit. @param commit publishes it during the lifetime of this
    /// object @throws OutputError
    void prepare(CommitList& commit);
    void warn(const std::string& sentence);
    /// Returns the warnings since the last call, one sentence each.
    [[nodiscard]] std::vector<std::string> take_warnings();

  private:
    struct Impl;  ///< because this header is included where GDAL's are not
    std::unique_ptr<Impl> impl_;
};

}  // namespace d2b::writing

#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "write/raster_target.hpp"

namespace d2b {

class CommitList;

/// File of a surface, written in pieces under a temporary name and published by a CommitList, like a GeoTIFF
/// of open_geotiff_sink(). Until then the destination is unchanged. A sink that writes two files has two of
/// these; dem2buildings/commit_list.hpp defines the order in which it prepares them.
class SurfaceFile {
  public:
    explicit SurfaceFile(RasterPlace place);
    SurfaceFile(const SurfaceFile&) = delete;
    SurfaceFile& operator=(const SurfaceFile&) = delete;
    ~SurfaceFile();

    /// Appends bytes. @throws OutputError
    void write(std::string_view bytes);
    /// Completes the file and adds it to a commit. @param commit publishes it during the lifetime of this
    /// object @throws OutputError
    void prepare(CommitList& commit);
    /// Call instead of prepare() if there is nothing to publish; adds a warning. @param why for example "an
    /// STL without a solid is none"
    void leave_out(const std::string& why);
    void warn(const std::string& sentence);
    /// Returns the warnings since the last call, one sentence each.
    [[nodiscard]] std::vector<std::string> take_warnings();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace d2b

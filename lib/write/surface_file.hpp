#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "write/raster_target.hpp"

namespace d2b {

class CommitList;

/// A file of a surface on its way: written beside its place in pieces, and then put there whole by a
/// CommitList, as a GeoTIFF of open_geotiff_sink() is. Without that the place stays as it was. A sink that
/// writes two files has two of these; dem2buildings/commit_list.hpp says in which order it prepares them.
class SurfaceFile {
  public:
    explicit SurfaceFile(RasterPlace place);
    SurfaceFile(const SurfaceFile&) = delete;
    SurfaceFile& operator=(const SurfaceFile&) = delete;
    ~SurfaceFile();

    /// Adds bytes to its end. @throws OutputError
    void write(std::string_view bytes);
    /// Completes it and adds it to what is to be shown. @param commit shows it while this lives @throws
    /// OutputError
    void prepare(CommitList& commit);
    /// In its place, where there is nothing to be published: warns of it. @param why "an STL without a solid
    /// is none"
    void leave_out(const std::string& why);
    void warn(const std::string& sentence);
    /// What has been noticed since the last call, a sentence each.
    [[nodiscard]] std::vector<std::string> take_warnings();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace d2b

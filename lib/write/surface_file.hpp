#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "write/raster_target.hpp"

namespace d2b {

/// A file of a surface on its way: written beside its place in pieces, and then put there whole, as a GeoTIFF
/// of open_geotiff_sink() is. Without publish() the place stays as it was.
class SurfaceFile {
  public:
    explicit SurfaceFile(RasterPlace place);
    SurfaceFile(const SurfaceFile&) = delete;
    SurfaceFile& operator=(const SurfaceFile&) = delete;
    ~SurfaceFile();

    /// Adds bytes to its end. @throws OutputError
    void write(std::string_view bytes);
    /// Makes it visible. @throws OutputError
    void publish();
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

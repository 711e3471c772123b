#pragma once

#include <memory>
#include <string>
#include <vector>

#include "preview/canvas.hpp"
#include "write/raster_target.hpp"

namespace d2b {

/// A picture in PNG that appears whole or not at all, as a GeoTIFF of open_geotiff_sink() does.
class PictureFile {
  public:
    PictureFile() = default;
    PictureFile(const PictureFile&) = delete;
    PictureFile& operator=(const PictureFile&) = delete;
    virtual ~PictureFile() = default;

    /// Writes it where nobody sees it yet. @throws OutputError
    virtual void write(const Image& image) = 0;
    /// Makes it visible. @throws OutputError
    virtual void publish() = 0;
    /// What has been noticed since the last call, a sentence each.
    [[nodiscard]] virtual std::vector<std::string> take_warnings() = 0;
};

/// The checks that need no picture are made here. @throws OptionError, OutputError as locate_raster()
[[nodiscard]] std::unique_ptr<PictureFile> open_picture(const RasterTarget& target);

}  // namespace d2b

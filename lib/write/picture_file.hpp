#pragma once

#include <memory>
#include <string>
#include <vector>

#include "preview/picture_format.hpp"
#include "write/raster_target.hpp"

namespace d2b {

class CommitList;

/// A picture that appears whole or not at all, as a GeoTIFF of open_geotiff_sink() does.
class PictureFile {
  public:
    PictureFile() = default;
    PictureFile(const PictureFile&) = delete;
    PictureFile& operator=(const PictureFile&) = delete;
    virtual ~PictureFile() = default;

    /// As the extension of the name says.
    [[nodiscard]] virtual PictureFormat format() const = 0;
    /// Writes it where nobody sees it yet. @param bytes of the whole file @throws OutputError
    virtual void write(const std::string& bytes) = 0;
    /// Adds it to what is to be shown. @param commit shows it while this lives @throws OutputError
    virtual void prepare(CommitList& commit) = 0;
    /// What has been noticed since the last call, a sentence each.
    [[nodiscard]] virtual std::vector<std::string> take_warnings() = 0;
};

/// The checks that need no picture are made here. @throws OptionError, OutputError as locate_raster()
[[nodiscard]] std::unique_ptr<PictureFile> open_picture(const RasterTarget& target);

}  // namespace d2b

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "write/ogr_call.hpp"
#include "write/raster_target.hpp"
#include "write/staging.hpp"

namespace d2b {

/// A raster file on its way: written beside its place, and then put there whole. Without publish() the place
/// stays as it was, and nothing is left beside it.
class StagedRaster {
  public:
    explicit StagedRaster(RasterPlace place);
    StagedRaster(const StagedRaster&) = delete;
    StagedRaster& operator=(const StagedRaster&) = delete;
    ~StagedRaster();

    [[nodiscard]] const std::string& name() const { return place_.name; }
    /// Whether there is an old one in its place.
    [[nodiscard]] bool replaces() const { return !place_.old_files.empty(); }
    /// For messages about it.
    [[nodiscard]] const WriteTarget& target() const { return target_; }
    /// @return the path of the file to write
    [[nodiscard]] std::string begin();
    /// The file is closed. @param renaming for a message, where it has to be renamed @throws OutputError
    void publish(const std::string& renaming);
    [[nodiscard]] std::vector<std::string> take_warnings() { return warnings_.take(); }

  private:
    RasterPlace place_;
    Warnings warnings_;
    WriteTarget target_;
    std::optional<Staging> staging_;
    std::string beside_;  ///< what is written meanwhile in a virtual file system
};

}  // namespace d2b

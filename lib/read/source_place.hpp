#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dem2buildings/options.hpp"
#include "read/temporary_file.hpp"

namespace d2b::reading {

/// Returns the rasters that a source names: those of a folder, sorted by name, or several, one per line;
/// empty for a single raster. Overviews and masks in a folder do not count, nor do mosaics beside other
/// rasters.
/// @throws InputError if a folder holds no raster or cannot be read
[[nodiscard]] std::vector<std::string> rasters_of(const std::string& source);

/// Place where GDAL opens the source of the options: the source itself, a copy of standard input, or a mosaic
/// in memory of several sources or of the rasters in a folder. The destructor removes a copy or mosaic.
class SourcePlace {
  public:
    /// @throws InputError as build_mosaic(), rasters_of() and copy_standard_input(); OptionError for options
    /// of a single raster with a mosaic
    explicit SourcePlace(const ReadOptions& options);
    SourcePlace(const SourcePlace&) = delete;
    SourcePlace& operator=(const SourcePlace&) = delete;
    ~SourcePlace();

    [[nodiscard]] const std::string& path() const { return path_; }
    /// Rasters of the mosaic; empty if the source is one raster.
    [[nodiscard]] const std::vector<std::string>& rasters() const { return rasters_; }
    /// Name of the source in messages.
    [[nodiscard]] const std::string& name() const { return name_; }

  private:
    std::unique_ptr<TemporaryFile> standard_input_;
    std::vector<std::string> rasters_;
    std::string path_;
    std::string name_;
};

}  // namespace d2b::reading

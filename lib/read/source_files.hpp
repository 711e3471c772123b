#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dem2buildings/options.hpp"

namespace d2b::reading {

/// Advice about a source that does not open as a raster, as the end of a sentence that begins with "; ": it
/// is a point cloud, an archive (with the raster in it, if there is one) or a vector dataset. Returns "" if
/// its kind is unknown.
[[nodiscard]] std::string open_failure_advice(const std::string& path);

/// Advice about a raster that cannot be read, likewise. @param driver GDAL's short name
[[nodiscard]] std::string read_failure_advice(const std::string& path, const std::string& driver);

/// File that a source is read from.
struct SourceFile {
    std::string name;
    std::int64_t size = -1;     ///< bytes; -1 if unknown
    std::int64_t modified = 0;  ///< seconds since 1970; 0 if unknown

    friend bool operator==(const SourceFile&, const SourceFile&) = default;
};

/// Lists all files of a raster, including those of nested VRTs, sorted by name. @throws InputError if it
/// cannot be opened
[[nodiscard]] std::vector<SourceFile> source_files(const ReadOptions& options);

/// Lists the files of accompanying data in the order terrain model, mask, NDVI, parcels, cutline; those of
/// each are sorted by name.
[[nodiscard]] std::vector<SourceFile> list_auxiliary_files(const Options& options);

}  // namespace d2b::reading

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dem2buildings/options.hpp"

namespace d2b {

/// A file that a source is read from.
struct SourceFile {
    std::string name;
    std::int64_t size = -1;     ///< bytes; -1 where it is not known
    std::int64_t modified = 0;  ///< seconds since 1970; 0 where it is not known

    friend bool operator==(const SourceFile&, const SourceFile&) = default;
};

/// All files behind a raster, as GDAL lists them: of a VRT those that it is made of as well, however deep.
/// Sorted by name. @throws InputError where it cannot be opened
[[nodiscard]] std::vector<SourceFile> source_files(const ReadOptions& options);

/// The same of what lies beside it: a terrain model, a mask, an NDVI, a cutline. One after the other, each
/// sorted by name.
[[nodiscard]] std::vector<SourceFile> side_files(const Options& options);

}  // namespace d2b

#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "write/ogr_call.hpp"
#include "write/vector_format.hpp"

namespace d2b {

/// Names of layers and how many features each should hold.
using LayerCounts = std::vector<std::pair<std::string, std::int64_t>>;

/// Of an open database: what it holds, not what the driver remembers. @throws OutputError
[[nodiscard]] std::int64_t count_rows(const WriteTarget& target, GDALDatasetH dataset,
                                      const std::string& layer);

/// Asks the open database, before it commits. @throws OutputError
void check_counts(const WriteTarget& target, GDALDatasetH dataset, const LayerCounts& counts);

/// Opens what was written and counts again. Formats that GDAL does not read are believed.
/// @throws OutputError where a layer or a feature is missing
void verify_counts(const WriteTarget& target, const VectorFormat& format, const std::string& path,
                   const LayerCounts& counts);

}  // namespace d2b

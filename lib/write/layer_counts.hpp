#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "write/ogr_call.hpp"
#include "write/vector_format.hpp"

namespace d2b {

/// Layer names with the expected number of features.
using LayerCounts = std::vector<std::pair<std::string, std::int64_t>>;

/// Counts rows by SQL, because the driver may return a cached number. @throws OutputError
[[nodiscard]] std::int64_t count_rows(const WriteTarget& target, GDALDatasetH dataset,
                                      const std::string& layer);

/// Compares with the open database before the commit. @throws OutputError
void check_counts(const WriteTarget& target, GDALDatasetH dataset, const LayerCounts& counts);

/// Reopens the result and compares. Skips formats that GDAL cannot read. @throws OutputError if a layer or
/// feature is missing
void verify_counts(const WriteTarget& target, const VectorFormat& format, const std::string& path,
                   const LayerCounts& counts);

}  // namespace d2b

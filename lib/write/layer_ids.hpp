#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "dem2buildings/sinks.hpp"
#include "write/ogr_call.hpp"
#include "write/vector_format.hpp"

namespace d2b {

/// The largest number among the features of the layers, by their first fields; 0 where there is none. The
/// database is asked, within the transaction that it is in. @throws OutputError
[[nodiscard]] std::int64_t largest_id(const WriteTarget& target, GDALDatasetH database,
                                      std::span<const LayerSpec> layers);

/// The same of files, which are read to their ends. @throws OutputError also where a layer ends too early:
/// ids that follow would then be given twice
[[nodiscard]] std::int64_t largest_id(const WriteTarget& target, const VectorFormat& format,
                                      const std::string& path, std::span<const LayerSpec> layers);

}  // namespace d2b

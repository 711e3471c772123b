#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "dem2buildings/sinks.hpp"
#include "write/ogr_call.hpp"
#include "write/vector_format.hpp"

namespace d2b {

/// Returns the largest feature id of the layers, which is in their first field; 0 if there is none. Queries
/// the database within its transaction. @throws OutputError
[[nodiscard]] std::int64_t largest_id(const WriteTarget& target, GDALDatasetH database,
                                      std::span<const LayerSpec> layers);

/// Same for files, which are read completely. @throws OutputError, also if a layer ends early, because ids
/// would then be assigned twice
[[nodiscard]] std::int64_t largest_id(const WriteTarget& target, const VectorFormat& format,
                                      const std::string& path, std::span<const LayerSpec> layers);

}  // namespace d2b

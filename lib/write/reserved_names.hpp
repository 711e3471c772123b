#pragma once

#include <span>

#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"
#include "write/vector_format.hpp"

namespace d2b {

/// Rejects reserved table names and duplicate column names in SQLite databases. @throws OptionError if -nln
/// is a reserved name, or -lco gives a column the name of one of our fields
void refuse_reserved_names(const VectorFormat& format, const WriteOptions& options,
                           std::span<const LayerSpec> layers);

}  // namespace d2b

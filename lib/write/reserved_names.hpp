#pragma once

#include <span>

#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"
#include "write/vector_format.hpp"

namespace d2b {

/// In databases of SQLite some names of tables have a meaning, and each column has a name of its own.
/// @throws OptionError where -nln gives a layer such a name, or -lco a column the name of one of our fields
void refuse_reserved_names(const VectorFormat& format, const WriteOptions& options,
                           std::span<const LayerSpec> layers);

}  // namespace d2b

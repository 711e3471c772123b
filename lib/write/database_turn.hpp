#pragma once

#include <span>
#include <string>

#include "dem2buildings/sinks.hpp"
#include "write/ogr_call.hpp"
#include "write/vector_format.hpp"

namespace d2b {

/// Takes a write lock on our layers until the transaction ends, so that values read from them stay true.
/// Needed because SQLite transactions begin as readers and PostgreSQL lets two writers run concurrently.
/// @return false if others held the database during the whole attempt; the transaction is then useless
/// @throws OutputError if the database refuses
[[nodiscard]] bool take_turn(const WriteTarget& target, GDALDatasetH database, const VectorFormat& format,
                             std::span<const LayerSpec> layers);

}  // namespace d2b

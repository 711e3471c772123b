#pragma once

#include <span>
#include <string>

#include "dem2buildings/sinks.hpp"
#include "write/ogr_call.hpp"
#include "write/vector_format.hpp"

namespace d2b {

/// Makes the transaction that a database is in the only one that changes our layers until it ends, so that
/// what is read of them stays true; others wait. SQLite begins a transaction as one that reads, PostgreSQL
/// lets two write side by side.
/// @return false where others have kept the database from it for as long as a try lasts: the transaction is
/// of no more use then @throws OutputError where the database does not allow it
[[nodiscard]] bool take_turn(const WriteTarget& target, GDALDatasetH database, const VectorFormat& format,
                             std::span<const LayerSpec> layers);

}  // namespace d2b

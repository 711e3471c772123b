#pragma once

#include <span>
#include <string>

namespace d2b {

/// Removes the database name of some tables from a statement of SQLite: `main.buildings`, with any quotes,
/// becomes `buildings`, which refers to a temporary table if there is one.
[[nodiscard]] std::string without_database(const std::string& sql, std::span<const std::string> tables);

}  // namespace d2b

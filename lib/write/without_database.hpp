#pragma once

#include <span>
#include <string>

namespace d2b {

/// A statement of SQLite without the name of the database before those of some tables: `main.buildings`,
/// however it is quoted, becomes `buildings`, which means a temporary table where there is one.
[[nodiscard]] std::string without_database(const std::string& sql, std::span<const std::string> tables);

}  // namespace d2b

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "write/ogr_call.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// Quotes an identifier: "buildings"
[[nodiscard]] std::string sql_name(const std::string& name);
/// Quotes a string literal: 'buildings'
[[nodiscard]] std::string sql_text(const std::string& text);

using SqlRow = std::vector<std::string>;  ///< NULL is ""

/// Runs a query and calls `use` per row. Errors are reported through GDAL. @return true if the query ran
bool sql_query(GDALDatasetH dataset, const std::string& sql, const std::function<void(const SqlRow&)>& use);

/// Returns the first value of the first row; nothing if there is no row or the query fails.
[[nodiscard]] std::optional<std::string> sql_value(GDALDatasetH dataset, const std::string& sql);

/// Runs a statement. Errors are reported through GDAL.
void sql_run(GDALDatasetH dataset, const std::string& sql);

/// Same while writing a dataset. @param doing purpose, for messages @throws OutputError if it fails
void sql_must(GDALDatasetH dataset, const WriteTarget& target, const std::string& sql,
              const std::string& doing);

/// Runs a statement and suppresses messages. @return true if GDAL reported no error
bool sql_done(GDALDatasetH dataset, const std::string& sql);

}  // namespace d2b

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "write/ogr_call.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// A name in SQL, in its quotes: "buildings"
[[nodiscard]] std::string sql_name(const std::string& name);
/// A text in SQL: 'buildings'
[[nodiscard]] std::string sql_text(const std::string& text);

using SqlRow = std::vector<std::string>;  ///< NULL is ""

/// Runs a query and calls `use` with each of its rows. Errors are reported as GDAL does.
/// @return whether it could be run
bool sql_query(GDALDatasetH dataset, const std::string& sql, const std::function<void(const SqlRow&)>& use);

/// The first value of the first row; none where there is no row, or the query fails.
[[nodiscard]] std::optional<std::string> sql_value(GDALDatasetH dataset, const std::string& sql);

/// Runs a statement. Errors are reported as GDAL does.
void sql_run(GDALDatasetH dataset, const std::string& sql);

/// The same in the writing of a dataset. @param doing what it is for @throws OutputError where it fails
void sql_must(GDALDatasetH dataset, const WriteTarget& target, const std::string& sql,
              const std::string& doing);

/// Runs a statement. @return whether GDAL has reported no error; what it says goes no further
bool sql_done(GDALDatasetH dataset, const std::string& sql);

}  // namespace d2b

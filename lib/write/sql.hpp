#pragma once

#include <functional>
#include <optional>
#include <sqlite3.h>
#include <string>
#include <vector>

#include <gdal.h>

#include "write/ogr_util.hpp"

namespace d2b::writing {

/// Quotes an identifier: "buildings"
[[nodiscard]] std::string sql_identifier(const std::string& name);
/// Quotes a string literal: 'buildings'
[[nodiscard]] std::string sql_literal(const std::string& text);

using SqlRow = std::vector<std::string>;  ///< NULL is ""

/// Runs a query and calls `use` per row. Errors are reported through GDAL. @return true if the query ran
bool sql_query(GDALDatasetH dataset, const std::string& sql, const std::function<void(const SqlRow&)>& use);

/// Returns the first value of the first row; nothing if there is no row or the query fails.
[[nodiscard]] std::optional<std::string> sql_value(GDALDatasetH dataset, const std::string& sql);

/// Runs a statement. Errors are reported through GDAL.
void sql_run(GDALDatasetH dataset, const std::string& sql);

/// Same while writing a dataset. @param doing purpose, for messages @throws OutputError if it fails
void sql_run_or_throw(GDALDatasetH dataset, const WriteTarget& target, const std::string& sql,
                      const std::string& doing);

/// Runs a statement and suppresses messages. @return true if GDAL reported no error
bool sql_succeeds(GDALDatasetH dataset, const std::string& sql);

/// Returns the connection of a dataset; nullptr if the dataset is not SQLite, or if GDAL links a different
/// copy of SQLite, because handles are not interchangeable.
[[nodiscard]] sqlite3* sqlite_handle(GDALDatasetH dataset);

/// Prevents commits after SQLite has rolled back a transaction by itself. SQLite does so after a disk error,
/// and later statements are then committed one by one. A driver that continues after an error, as GDAL does
/// when it drops a layer, would leave half of the changes. After watch() no commit succeeds once a
/// transaction has been rolled back. Has an effect only if GDAL and this library share one copy of SQLite.
class CommitGuard {
  public:
    CommitGuard() = default;
    CommitGuard(const CommitGuard&) = delete;
    CommitGuard& operator=(const CommitGuard&) = delete;

    /// @param dataset in a transaction; must be closed before this object is destroyed. Ignored if it is not
    /// a SQLite database, because only SQLite rolls back by itself.
    void watch(GDALDatasetH dataset);
    /// True if the transaction has been rolled back.
    [[nodiscard]] bool rolled_back() const { return rolled_back_; }

  private:
    bool rolled_back_ = false;
};

}  // namespace d2b::writing

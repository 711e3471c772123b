#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <sqlite3.h>
#include <string>
#include <variant>

#include "write/ogr_call.hpp"
#include "write/ogr_handles.hpp"

namespace d2b {

/// Many rows for a table of a GeoPackage: bound to one statement, which takes a third of the time of text;
/// as text, in statements of some size, where the dataset's SQLite is another copy than this library's.
class RowInserts {
  public:
    using Cell = std::variant<std::int64_t, std::span<const std::byte>>;

    /// @param handle of the dataset; null: as text
    /// @param head e.g. INSERT INTO "a" VALUES @param doing for messages: what the rows are for
    RowInserts(GDALDatasetH dataset, sqlite3* handle, const WriteTarget& target, std::string head,
               std::string doing);

    /// @param row as many cells as in the row before @throws OutputError
    void add(std::initializer_list<Cell> row);
    /// After the last row. @throws OutputError
    void finish();

  private:
    void bind(std::initializer_list<Cell> row);
    void append(std::initializer_list<Cell> row);
    [[noreturn]] void fail() const;

    GDALDatasetH dataset_;
    sqlite3* handle_;
    const WriteTarget& target_;
    std::string head_;
    std::string doing_;
    std::string sql_;
    std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement_{nullptr, sqlite3_finalize};
};

}  // namespace d2b

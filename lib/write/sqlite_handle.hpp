#pragma once

#include <sqlite3.h>

#include <gdal.h>

namespace d2b {

/// The connection of a dataset; null where it is none of SQLite's, or one of another copy of SQLite than this
/// library runs on: a handle of one is none for the other.
[[nodiscard]] sqlite3* sqlite_handle(GDALDatasetH dataset);

}  // namespace d2b

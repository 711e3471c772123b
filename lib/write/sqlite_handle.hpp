#pragma once

#include <sqlite3.h>

#include <gdal.h>

namespace d2b {

/// Returns the connection of a dataset; nullptr if the dataset is not SQLite, or if GDAL links a different
/// copy of SQLite, because handles are not interchangeable.
[[nodiscard]] sqlite3* sqlite_handle(GDALDatasetH dataset);

}  // namespace d2b

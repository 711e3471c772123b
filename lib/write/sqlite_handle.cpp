#include "write/sqlite_handle.hpp"

#include "read/gdal_messages.hpp"
#include "write/sql.hpp"

namespace d2b {

sqlite3* sqlite_handle(GDALDatasetH dataset) {
    const GdalMessages quiet;
    auto* handle = static_cast<sqlite3*>(GDALGetInternalHandle(dataset, "SQLITE_HANDLE"));
    const bool ours =
        handle != nullptr && sql_value(dataset, "SELECT sqlite_source_id()") == sqlite3_sourceid();
    return ours ? handle : nullptr;
}

}  // namespace d2b

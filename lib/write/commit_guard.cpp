#include "write/commit_guard.hpp"

#include <sqlite3.h>
#include <string>

#include "read/gdal_messages.hpp"
#include "write/sql.hpp"

namespace d2b {

namespace {

int refuse_if_lost(void* lost) {
    return *static_cast<bool*>(lost) ? 1 : 0;
}

void note_loss(void* lost) {
    *static_cast<bool*>(lost) = true;
}

/// A handle of one copy of SQLite is none for another.
bool is_our_sqlite(GDALDatasetH dataset) {
    return sql_value(dataset, "SELECT sqlite_source_id()") == sqlite3_sourceid();
}

}  // namespace

void CommitGuard::watch(GDALDatasetH dataset) {
    const GdalMessages quiet;
    auto* handle = static_cast<sqlite3*>(GDALGetInternalHandle(dataset, "SQLITE_HANDLE"));
    if (handle == nullptr || !is_our_sqlite(dataset))
        return;
    sqlite3_rollback_hook(handle, note_loss, &lost_);
    sqlite3_commit_hook(handle, refuse_if_lost, &lost_);
}

}  // namespace d2b

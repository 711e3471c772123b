#include "write/commit_guard.hpp"

#include "write/sqlite_handle.hpp"

namespace d2b {

namespace {

int refuse_if_lost(void* lost) {
    return *static_cast<bool*>(lost) ? 1 : 0;
}

void note_loss(void* lost) {
    *static_cast<bool*>(lost) = true;
}

}  // namespace

void CommitGuard::watch(GDALDatasetH dataset) {
    sqlite3* const handle = sqlite_handle(dataset);
    if (handle == nullptr)
        return;
    sqlite3_rollback_hook(handle, note_loss, &lost_);
    sqlite3_commit_hook(handle, refuse_if_lost, &lost_);
}

}  // namespace d2b

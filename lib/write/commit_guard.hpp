#pragma once

#include <gdal.h>

namespace d2b {

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
    [[nodiscard]] bool lost() const { return lost_; }

  private:
    bool lost_ = false;
};

}  // namespace d2b

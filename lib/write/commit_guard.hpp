#pragma once

#include <gdal.h>

namespace d2b {

/// Where a disk fails, SQLite takes a whole transaction back by itself, and what is run after that is
/// committed statement by statement: a driver that goes on after an error, as GDAL does where it drops a
/// layer, would then leave half of it. From watch() on nothing is committed any more once a transaction has
/// been taken back. It needs the SQLite that GDAL runs on; with any other it does nothing.
class CommitGuard {
  public:
    CommitGuard() = default;
    CommitGuard(const CommitGuard&) = delete;
    CommitGuard& operator=(const CommitGuard&) = delete;

    /// @param dataset in a transaction; it must be closed before this object goes. One of another kind of
    /// database takes nothing back by itself.
    void watch(GDALDatasetH dataset);
    /// Whether the transaction has been taken back.
    [[nodiscard]] bool lost() const { return lost_; }

  private:
    bool lost_ = false;
};

}  // namespace d2b

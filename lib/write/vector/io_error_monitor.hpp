#pragma once

#include <string>

namespace d2b::writing {

/// VSI layer that records I/O errors. Many drivers ignore failed writes or crash on them, so they are told
/// that every write succeeded; error() returns the first failure. Drivers access files by name_of().
///
/// Not needed for drivers with transactions, because they report errors of the disk.
class IoErrorMonitor {
  public:
    IoErrorMonitor();
    IoErrorMonitor(const IoErrorMonitor&) = delete;
    IoErrorMonitor& operator=(const IoErrorMonitor&) = delete;
    ~IoErrorMonitor() = default;

    /// Returns the name by which a driver accesses a local file or folder, valid during the lifetime of this
    /// object.
    [[nodiscard]] std::string name_of(const std::string& path) const;
    /// errno of the first failed write; 0 if there is none.
    [[nodiscard]] int error() const { return error_; }

    /// Called by the VSI callbacks.
    void record(int error);

  private:
    std::string prefix_;
    int error_ = 0;
};

}  // namespace d2b::writing

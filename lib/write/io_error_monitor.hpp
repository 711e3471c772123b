#pragma once

#include <string>

namespace d2b::writing {

/// VSI layer that records I/O errors. Many drivers ignore failed writes or crash on them, so they are told
/// that every write succeeded; require_written() reports the first failure. Drivers access files by
/// name_of().
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
    /// @param name of the destination, for the message @throws OutputError if a write has failed
    void require_written(const std::string& name) const;

    /// Called by the VSI callbacks.
    void record(int error);

  private:
    std::string prefix_;
    int error_ = 0;  ///< errno of the first failed write; 0 if there is none
};

}  // namespace d2b::writing

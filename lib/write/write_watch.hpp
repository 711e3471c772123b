#pragma once

#include <string>

namespace d2b {

/// Files as a driver of GDAL's sees them under a name of this object's, and what the disk said to them.
/// Drivers pass over errors of the disk, or fall over them: here they are told that all is well, and error()
/// knows better.
class WriteWatch {
  public:
    WriteWatch();
    WriteWatch(const WriteWatch&) = delete;
    WriteWatch& operator=(const WriteWatch&) = delete;
    ~WriteWatch() = default;

    /// What a driver is to call a local file or folder. Good for as long as this object lives.
    [[nodiscard]] std::string name_of(const std::string& path) const;
    /// errno of the first write that failed; 0 where all is well.
    [[nodiscard]] int error() const { return error_; }

    /// For the callbacks.
    void note(int error);

  private:
    std::string prefix_;
    int error_ = 0;
};

}  // namespace d2b

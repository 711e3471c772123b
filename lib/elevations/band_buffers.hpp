#pragma once

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace d2b {

/// Pool of buffers for the elevations of bands. Reuse is faster, because the system clears newly allocated
/// pages, and vectors fill them with zeros again. Thread-safe.
class BandBuffers {
  public:
    /// Returns a buffer with arbitrary length and contents.
    [[nodiscard]] std::vector<double> take() {
        const std::lock_guard lock(mutex_);
        if (idle_.empty())
            return {};
        std::vector<double> buffer = std::move(idle_.back());
        idle_.pop_back();
        return buffer;
    }
    void give(std::vector<double>&& buffer) {
        const std::lock_guard lock(mutex_);
        idle_.push_back(std::move(buffer));
    }
    void clear() {
        const std::lock_guard lock(mutex_);
        idle_.clear();
    }

  private:
    std::mutex mutex_;
    std::vector<std::vector<double>> idle_;
};

}  // namespace d2b

#pragma once

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace d2b {

/// Lists of elevations that bands gave back, for the next ones: memory that is asked for anew is cleared page
/// by page, and filled with zeros once more. From any thread.
class BandBuffers {
  public:
    /// A list with whatever length and values.
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

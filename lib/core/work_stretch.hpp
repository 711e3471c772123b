#pragma once

#include <chrono>
#include <cstddef>
#include <typeinfo>

#include "dem2buildings/callbacks.hpp"

namespace d2b {

/// Reports its lifetime as a span of work of a thread.
class WorkStretch {
  public:
    using Clock = std::chrono::steady_clock;

    /// @param listener if null, nothing is reported and no clock is read
    WorkStretch(const WorkListener* listener, std::size_t thread, const std::type_info& work)
        : listener_(listener), span_{thread, &work, now(), {}} {}
    WorkStretch(const WorkStretch&) = delete;
    WorkStretch& operator=(const WorkStretch&) = delete;
    ~WorkStretch() { tell(); }

    /// Excludes a wait from the reported time.
    template <typename Wait>
    void interrupt(const Wait& wait) {
        tell();
        wait();
        span_.begin = now();
    }

  private:
    [[nodiscard]] Clock::time_point now() const {
        return listener_ != nullptr ? Clock::now() : Clock::time_point();
    }
    void tell() {
        if (listener_ == nullptr)
            return;
        span_.end = now();
        (*listener_)(span_);
    }

    const WorkListener* listener_;
    WorkSpan span_;
};

}  // namespace d2b

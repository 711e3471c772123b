#pragma once

#include <chrono>
#include <cstddef>
#include <typeinfo>

#include "dem2buildings/callbacks.hpp"

namespace d2b {

/// Tells of the time that a thread works, from its making on to its end.
class WorkStretch {
  public:
    using Clock = std::chrono::steady_clock;

    /// @param listener null: tells nobody, and looks at no clock
    WorkStretch(const WorkListener* listener, std::size_t thread, const std::type_info& work)
        : listener_(listener), span_{thread, &work, now(), {}} {}
    WorkStretch(const WorkStretch&) = delete;
    WorkStretch& operator=(const WorkStretch&) = delete;
    ~WorkStretch() { tell(); }

    /// For a wait: that is no work.
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

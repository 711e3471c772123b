#pragma once

#include <functional>
#include <utility>

#include "core/context.hpp"

namespace d2b {

/// Maps progress from 0 to 1, as reported through a context, to a part [begin, end] of the whole as long as
/// it lives.
class ProgressSpan {
  public:
    ProgressSpan(Context& context, double begin, double end)
        : context_(context), outer_(std::exchange(context.on_progress, {})) {
        if (outer_)
            context.on_progress = [this, begin, end](double share) {
                return outer_(begin + (end - begin) * share);
            };
    }
    ProgressSpan(const ProgressSpan&) = delete;
    ProgressSpan& operator=(const ProgressSpan&) = delete;
    ~ProgressSpan() { context_.on_progress = std::move(outer_); }

  private:
    Context& context_;
    std::function<bool(double)> outer_;
};

}  // namespace d2b

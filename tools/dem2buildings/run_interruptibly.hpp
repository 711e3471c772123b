#pragma once

#include <functional>

namespace d2b {

/// Runs a function that asks interrupted() whether to end. After a signal it ends with Cancelled, or with an
/// error where the signal broke off a read; either becomes a line on stderr.
/// @return the exit status @throws the exceptions of `run` without a signal
[[nodiscard]] int run_interruptibly(const std::function<void()>& run);

}  // namespace d2b

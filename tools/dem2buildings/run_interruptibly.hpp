#pragma once

#include <functional>

namespace d2b {

/// Runs what asks interrupted() whether it is to end. After a signal it ends with a Cancelled, or with an
/// error where the signal broke off a read; either becomes a line on stderr.
/// @return the exit status @throws what `run` throws without a signal
[[nodiscard]] int run_interruptibly(const std::function<void()>& run);

}  // namespace d2b

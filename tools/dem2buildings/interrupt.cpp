#include "dem2buildings/interrupt.hpp"

#include <atomic>

#include "core/system/process.hpp"

namespace d2b {
namespace {

// A signal handler can reach only global variables, and none that takes a lock.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
std::atomic<int> signal_seen = 0;
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void on_signal(int signal) {
    signal_seen = signal;
}

}  // namespace

void catch_interrupts() {
    signal_seen = 0;
    system::catch_signals(on_signal);
}

bool interrupted() {
    return signal_seen != 0;
}

int interrupt_status() {
    constexpr int ended_by_signal = 128;
    return ended_by_signal + signal_seen;
}

}  // namespace d2b

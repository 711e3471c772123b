#include "dem2buildings/interrupt.hpp"

#include <array>
#include <atomic>
#include <csignal>

namespace d2b {
namespace {

// A signal handler can reach nothing but what is global, and nothing that takes a lock.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
std::atomic<int> signal_seen = 0;
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void on_signal(int signal) {
    signal_seen = signal;
    static_cast<void>(std::signal(signal, SIG_DFL));
}

}  // namespace

void catch_interrupts() {
    signal_seen = 0;
    for (const int signal : std::array{SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        // Who started this process in the background, or with nohup, may have set the signal aside; it stays
        // aside.
        if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN)
            continue;
        // Without SA_RESTART: a read that waits for the standard input has to give up.
        struct sigaction action {};
        action.sa_handler = on_signal;
        sigemptyset(&action.sa_mask);
        static_cast<void>(sigaction(signal, &action, nullptr));
    }
}

bool interrupted() {
    return signal_seen != 0;
}

int interrupt_status() {
    constexpr int ended_by_signal = 128;
    return ended_by_signal + signal_seen;
}

}  // namespace d2b

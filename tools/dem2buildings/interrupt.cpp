#include "dem2buildings/interrupt.hpp"

#include <csignal>

namespace d2b {
namespace {

// A signal handler can reach nothing but what is global.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
volatile std::sig_atomic_t interrupt_seen = 0;

extern "C" void on_interrupt(int signal) {
    interrupt_seen = 1;
    static_cast<void>(std::signal(signal, SIG_DFL));
}

}  // namespace

void catch_interrupts() {
    interrupt_seen = 0;
    // Who started this process in the background may have set the signal aside; then it stays aside.
    if (std::signal(SIGINT, on_interrupt) == SIG_IGN)
        static_cast<void>(std::signal(SIGINT, SIG_IGN));
}

bool interrupted() {
    return interrupt_seen != 0;
}

}  // namespace d2b

#pragma once

namespace d2b {

/// Lets Ctrl-C (SIGINT), SIGTERM and SIGHUP ask for an end instead of ending the process. A second one of the
/// same kind ends it. Nothing changes for a signal that the process was started with ignored.
void catch_interrupts();

/// Whether one of them has come. Any thread may ask.
[[nodiscard]] bool interrupted();

/// Exit status that a shell reports for a program ended by the signal: 130 for SIGINT, 143 for SIGTERM.
[[nodiscard]] int interrupt_status();

}  // namespace d2b

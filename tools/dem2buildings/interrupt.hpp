#pragma once

namespace d2b {

/// Lets Ctrl-C (SIGINT) ask for an end instead of ending the process. A second one ends it.
/// Nothing changes where the process was started with SIGINT ignored.
void catch_interrupts();

/// Whether Ctrl-C has been pressed.
[[nodiscard]] bool interrupted();

}  // namespace d2b

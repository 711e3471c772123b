#pragma once

#include <string>

namespace d2b {

// Texts about the program; ASCII, and they end with a line feed.

/// Two lines, for a command line without arguments.
[[nodiscard]] std::string tiles_short_usage();
/// The text of --help, in lines of at most 80 characters.
[[nodiscard]] std::string tiles_help();
/// The man page, as roff.
[[nodiscard]] std::string tiles_man_page();
/// A script that completes command lines in Bash.
[[nodiscard]] std::string tiles_bash_completion();

}  // namespace d2b

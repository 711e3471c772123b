#pragma once

#include <string>

namespace d2b {

// All texts about the options are made from compare_options(). They are ASCII and end with a line feed.

/// Two lines, for a command line without arguments.
[[nodiscard]] std::string compare_short_usage();
/// Text that --help prints, in lines of at most 80 characters.
[[nodiscard]] std::string compare_help();
/// The man page, as roff.
[[nodiscard]] std::string compare_man_page();

}  // namespace d2b

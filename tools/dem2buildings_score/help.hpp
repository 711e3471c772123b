#pragma once

#include <string>

namespace d2b {

// All texts about the options are made from score_options(). They are ASCII and end with a line feed.

/// Two lines, for a command line without arguments.
[[nodiscard]] std::string score_short_usage();
/// The text of --help, in lines of at most 80 characters.
[[nodiscard]] std::string score_help();
/// The man page, as roff.
[[nodiscard]] std::string score_man_page();
/// The options for measures of footprints, as JSON: name, kind and help of each.
[[nodiscard]] std::string score_options_json();

}  // namespace d2b

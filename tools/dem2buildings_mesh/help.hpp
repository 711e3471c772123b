// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace d2b::mesh {

// All texts about the options are made from mesh_options(). They are ASCII and end with a line feed.

/// Two lines, for a command line without arguments.
[[nodiscard]] std::string mesh_short_usage();
/// The text of --help, in lines of at most 80 characters.
[[nodiscard]] std::string mesh_help();
/// The man page, as roff.
[[nodiscard]] std::string mesh_man_page();
/// Completes command lines in Bash.
[[nodiscard]] std::string mesh_bash_completion();

}  // namespace d2b::mesh

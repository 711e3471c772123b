#pragma once

#include <string>

#include "common/help_text.hpp"
#include "options/option_table.hpp"

namespace d2b {

// All texts about the options are made from the table of options. They are ASCII and end with a line feed.

/// Two lines, for a command line without arguments.
[[nodiscard]] std::string short_usage();

/// Returns the everyday options for --help, in lines of at most 80 characters.
[[nodiscard]] std::string everyday_help();

/// Returns all options for --help_all, in lines of at most 80 characters.
[[nodiscard]] std::string full_help();

/// The man page, as roff.
[[nodiscard]] std::string man_page();

/// The reference of the options, with the fate of each option of gdal_contour, as Markdown.
[[nodiscard]] std::string options_markdown();

/// The table of options as JSON, for dialogs that are made of it.
[[nodiscard]] std::string options_json();

/// A script that completes command lines in Bash.
[[nodiscard]] std::string bash_completion();

/// Returns range, unit, default, whether an option may be repeated, and the presets that refuse it, as
/// sentences, without those that repeat the synopsis.
/// @param brief without the presets
[[nodiscard]] std::string option_facts(const OptionRow& row, bool brief = false);

/// The option and its aliases: "-f, -of <format>".
[[nodiscard]] std::string option_heading(const OptionRow& row);

}  // namespace d2b

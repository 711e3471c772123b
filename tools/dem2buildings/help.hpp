#pragma once

#include <string>

#include "common/help_text.hpp"
#include "options/option_table.hpp"

namespace d2b {

// All texts about the options are made from the table of options. They are ASCII and end with a line feed.

/// Two lines, for a command line without arguments.
[[nodiscard]] std::string short_usage();

/// What --help prints, in lines of at most 80 characters.
[[nodiscard]] std::string full_help();

/// The man page, as roff.
[[nodiscard]] std::string man_page();

/// The reference of the options, with the fate of each option of gdal_contour, as Markdown.
[[nodiscard]] std::string options_markdown();

/// The table of options as JSON, for dialogs that are made of it.
[[nodiscard]] std::string options_json();

/// A script that completes command lines in Bash.
[[nodiscard]] std::string bash_completion();

/// What a value is, for those who ask for it in another way than as text: "switch", "choice", "whole",
/// "number", "numbers", "extent", "crs", "raster", "vector", "dataset" (either of them), "terrain" (a word or
/// a raster), "file:<extension>" (which is written) or "text".
[[nodiscard]] std::string option_kind(const OptionRow& row);
/// The words that the option takes, as its synopsis lists them.
[[nodiscard]] std::vector<std::string> option_words(const OptionRow& row);

/// Range, unit, default and whether it may be repeated, as sentences; "" where there is nothing to say.
/// @param brief without the range of several values, which takes a line
[[nodiscard]] std::string option_facts(const OptionRow& row, bool brief = false);

/// The option and its aliases: "-f, -of <format>".
[[nodiscard]] std::string option_heading(const OptionRow& row);

}  // namespace d2b

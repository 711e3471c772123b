#pragma once

#include <string>
#include <vector>

#include "options/option_table.hpp"

namespace d2b {

/// Reads a command line; opens no file. Options may stand anywhere, with one dash or two, their values behind
/// a blank or an equals sign; the sources stand before the destination; "--" ends the options. Where help,
/// the version, the man page or the reference is asked for, nothing else is looked at.
/// @param arguments without the program's name and without GDAL's own switches
/// @throws OptionError
[[nodiscard]] Request parse_command_line(const std::vector<std::string>& arguments);

/// Returns the source of ReadOptions for one or several names. @throws OptionError
[[nodiscard]] std::string source_of(const std::vector<std::string>& names);

/// @throws OptionError: the destination is the source
void require_other_file(const std::string& source, const std::string& destination);

/// Whether the result itself goes to stdout, so that nothing else may.
[[nodiscard]] bool writes_to_stdout(const Request& request);

}  // namespace d2b

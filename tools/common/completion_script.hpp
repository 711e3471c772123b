#pragma once

#include <string>

namespace d2b {

/// A script for Bash: completes by the case of an option after it, by names after a dash, else by files.
/// @param cases of a `case` over the word before, each a line that returns
/// @param names with their dashes, blanks between them
[[nodiscard]] std::string completion_script(const std::string& program, const std::string& cases,
                                            const std::string& names);

}  // namespace d2b
